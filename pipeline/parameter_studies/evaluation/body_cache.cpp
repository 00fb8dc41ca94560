// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/evaluation/body_cache.h"

#include <utility>
#include <vector>

#include "geometry/foundation/error.h"
#include "pipeline/run/make_mesh.h"
#include "pipeline/run/results_folder.h"

namespace flexneck::pipeline {

namespace {

std::string text_of(const std::vector<Parameter>& parameters) {
  std::string text;
  for (const Parameter& each : parameters) text += each.key + '\n' + each.value + '\n';
  return text;
}

}  // namespace

template <class Thing>
const Thing* BodyCache::Last<Thing>::find(const std::string& key) {
  const auto place = places_.find(key);
  if (place == places_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, place->second);
  note_reads(entries_.front().reads);
  return &entries_.front().thing;
}

template <class Thing>
void BodyCache::Last<Thing>::keep(const std::string& key, Thing thing, const FilesRead& reads) {
  entries_.push_front({key, std::move(thing), reads.files()});
  places_[key] = entries_.begin();
  if (entries_.size() <= count_) return;
  places_.erase(entries_.back().key);
  entries_.pop_back();
}

BodyCache::~BodyCache() {
  solvers_.run([this] { session_.reset(); });  // on the thread that started the session
}

void BodyCache::start() {
  solvers_.run([this] {
    if (!session_) session_.emplace();
  });
}

BodyCache::Body BodyCache::known(const std::string& key) {
  const std::scoped_lock lock(mutex_);
  const Body* const found = bodies_.find(key);
  return found == nullptr ? nullptr : *found;
}

BodyCache::Body BodyCache::body(const Study& study, BodyUse use) {
  const std::string key = text_of(modes_values(study, use == BodyUse::attached)) +
                          std::to_string(static_cast<int>(use));
  Body found = known(key);
  if (found) return found;
  start();
  solvers_.run([&] {
    found = known(key);  // another thread may have computed the same body meanwhile
    if (found) return;
    const FilesRead reads;
    found = std::make_shared<const fe_modal::ModalBody>(without_shapes(solved(study, use)));
    const std::scoped_lock lock(mutex_);
    bodies_.keep(key, found, reads);
    ++solved_;
  });
  return found;
}

BodyCache::StructurePieces BodyCache::pieces(const Study& study) {
  const std::string key = text_of(modes_values(study, false));
  StructurePieces found;
  start();
  solvers_.run([&] {
    if (const StructurePieces* const known = pieces_.find(key)) {
      found = *known;
      return;
    }
    const FilesRead reads;
    found = std::make_shared<const Pieces>(modes_of_pieces(study, mesh_of(study)));
    pieces_.keep(key, found, reads);
  });
  return found;
}

std::size_t BodyCache::solved_count() const {
  const std::scoped_lock lock(mutex_);
  return solved_;
}

FigureSlopes BodyCache::slopes(const Study& study, BodyUse use,
                               const std::vector<MovedStudy>& moved,
                               const std::vector<std::string>& figures) {
  FigureSlopes found;
  start();
  solvers_.run([&] { found = modes_slopes(study, mesh_of(study), use, moved, figures, console_); });
  const std::scoped_lock lock(mutex_);
  ++solved_;
  return found;
}

const mesher::Mesh& BodyCache::mesh_of(const Study& study) {
  const std::string key = text_of(mesh_values(study));
  if (const mesher::Mesh* const mesh = meshes_.find(key)) return *mesh;
  const FilesRead reads;
  meshes_.keep(key, make_mesh(study, console_), reads);
  return *meshes_.find(key);
}

fe_modal::ModalBody BodyCache::solved(const Study& study, BodyUse use) {
  if (study.structure) return modes_of_mesh(study, mesh_of(study), use);
  if (!study.matrices)
    throw InputError(study.file.string() +
                     ": expected [geometry] or [matrices] for the modes, found neither");
  return solved_matrices(study);
}

}  // namespace flexneck::pipeline
