// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/build_id.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <elf.h>
#include <link.h>
#include <span>
#include <string_view>

#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/running_object.h"

namespace flexneck {

namespace {

using Bytes = std::span<const unsigned char>;

std::string hexadecimal(Bytes bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 0xFU];
  }
  return text;
}

/// The build id among the notes of an ELF file. Each note is a header, a name and a description,
/// each padded to four bytes.
std::string id_in(Bytes notes) {
  constexpr auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
  while (notes.size() > sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) head;
    std::memcpy(&head, notes.data(), sizeof head);
    const std::size_t name = sizeof head;
    const std::size_t content = name + padded(head.n_namesz);
    const std::size_t end = content + padded(head.n_descsz);
    if (end > notes.size()) break;
    if (head.n_type == NT_GNU_BUILD_ID && head.n_namesz == sizeof ELF_NOTE_GNU &&
        std::memcmp(notes.data() + name, ELF_NOTE_GNU, sizeof ELF_NOTE_GNU) == 0)
      return hexadecimal(notes.subspan(content, head.n_descsz));
    notes = notes.subspan(end);
  }
  return {};
}

/// Its address lies in the loaded object whose build id is sought.
const char kHere = 0;

bool holds_this(const dl_phdr_info& info) {
  const auto here = std::bit_cast<ElfW(Addr)>(&kHere);
  const std::span parts(info.dlpi_phdr, info.dlpi_phnum);
  return std::any_of(parts.begin(), parts.end(), [&](const ElfW(Phdr) & part) {
    const ElfW(Addr) begin = info.dlpi_addr + part.p_vaddr;
    return part.p_type == PT_LOAD && begin <= here && here < begin + part.p_memsz;
  });
}

/// Callback of dl_iterate_phdr: called for each loaded object until it returns 1.
int look_into(dl_phdr_info* info, std::size_t /*size*/, void* found) {
  if (!holds_this(*info)) return 0;
  for (const ElfW(Phdr) & part : std::span(info->dlpi_phdr, info->dlpi_phnum)) {
    if (part.p_type != PT_NOTE) continue;
    // The loader gives addresses as numbers.
    const auto* begin = std::bit_cast<const unsigned char*>(info->dlpi_addr + part.p_vaddr);
    const std::string id = id_in({begin, part.p_memsz});
    if (!id.empty()) *static_cast<std::string*>(found) = id;
  }
  return 1;
}

std::string found_id() {
  std::string id;
  dl_iterate_phdr(look_into, &id);
  return id.empty() ? hash_of_file(running_object().string()) : id;
}

}  // namespace

std::string build_id() {
  static const std::string id = found_id();
  return id;
}

}  // namespace flexneck
