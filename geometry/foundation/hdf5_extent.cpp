// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/hdf5_extent.h"

#include <cmath>
#include <vector>

namespace flexneck {

namespace {

/// Bound of the compression ratio: zlib's largest is 1032.
constexpr double kMaxCompression = 1040;

std::string filter_problem(const Hdf5Handle& creation, int filters) {
  unsigned found = 0;
  for (unsigned k = 0; k < static_cast<unsigned>(filters); ++k) {
    std::size_t values = 0;
    const H5Z_filter_t filter =
        H5Pget_filter2(creation.get(), k, nullptr, &values, nullptr, 0, nullptr, nullptr);
    const bool is_known = filter == H5Z_FILTER_DEFLATE || filter == H5Z_FILTER_SHUFFLE ||
                          filter == H5Z_FILTER_FLETCHER32;
    if (!is_known || (found & (1U << static_cast<unsigned>(filter))) != 0) {
      return "expected no other filters than gzip, shuffle and fletcher32, each once, found "
             "filter " +
             std::to_string(filter);
    }
    found |= 1U << static_cast<unsigned>(filter);
  }
  return {};
}

/// Extents, slowest index first; none if HDF5 cannot tell.
std::optional<std::vector<double>> extents_of(const Hdf5Handle& space) {
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 0) return {};
  std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
  if (H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr) < 0) return {};
  return std::vector<double>(extents.begin(), extents.end());
}

/// Number of chunks of a dataset with these extents.
double chunk_count(const std::vector<double>& extents, const Hdf5Handle& creation) {
  std::vector<hsize_t> chunk(extents.size(), 1);
  H5Pget_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data());
  double count = 1;
  for (std::size_t k = 0; k < chunk.size(); ++k)
    count *= std::ceil(extents[k] / static_cast<double>(chunk[k]));
  return count;
}

}  // namespace

std::optional<std::string> extent_problem(const Hdf5Handle& dataset, std::uintmax_t file_size) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset.get()), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(creation.get());
  const int foreign_files = H5Pget_external_count(creation.get());
  const int filters = H5Pget_nfilters(creation.get());
  if (layout < 0 || foreign_files < 0 || filters < 0) return {};
  // This comes first: other queries might let HDF5 open another file.
  if (layout == H5D_VIRTUAL || foreign_files > 0) {
    return "expected data in this file, found them in another one";
  }
  if (std::string problem = filter_problem(creation, filters); !problem.empty()) return problem;

  const Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose);
  const std::optional<std::vector<double>> extents = extents_of(space);
  if (!type || !extents) return {};
  double bytes = static_cast<double>(H5Tget_size(type.get()));
  for (const double extent : *extents) bytes *= extent;
  if (bytes > (filters > 0 ? kMaxCompression : 1) * static_cast<double>(file_size)) {
    return "is larger than its file can hold";
  }
  hsize_t chunks = 0;
  if (layout == H5D_CHUNKED && H5Dget_num_chunks(dataset.get(), space.get(), &chunks) < 0)
    return {};
  const bool is_written = layout == H5D_CHUNKED
                              ? static_cast<double>(chunks) >= chunk_count(*extents, creation)
                              : static_cast<double>(H5Dget_storage_size(dataset.get())) >= bytes;
  return bytes == 0 || is_written ? "" : "was never written";
}

}  // namespace flexneck
