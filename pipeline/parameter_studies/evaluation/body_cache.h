// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "fe_modal/algebra/petsc_session.h"
#include "fe_modal/body/modal_body.h"
#include "geometry/foundation/files_read.h"
#include "mesher/mesh/mesh.h"
#include "pipeline/language/model/piece_sections.h"
#include "pipeline/language/study/study.h"
#include "pipeline/parameter_studies/evaluation/modes_slopes.h"
#include "pipeline/parameter_studies/evaluation/serial_thread.h"
#include "pipeline/parameter_studies/evaluation/structure_modes.h"
#include "pipeline/process/console.h"

namespace flexneck::pipeline {

/// Meshes and modes of studies that differ in some values, each computed once for all studies that
/// share the values it depends on. They are computed one at a time, on a thread of their own, since
/// gmsh and PETSc allow only one. The last kBodies bodies and kPieces sets of submeshes, without
/// shapes, and kMeshes meshes are kept. Safe for any number of threads. At most one cache in a
/// process, like fe_modal::PetscSession.
class BodyCache {
 public:
  using Body = std::shared_ptr<const fe_modal::ModalBody>;
  static constexpr std::size_t kBodies = 2000;  ///< about 10 kB each
  static constexpr std::size_t kPieces = 200;   ///< about 100 kB each
  static constexpr std::size_t kMeshes = 4;

  /// @param console  takes the messages of meshing; outlives this
  explicit BodyCache(const Console& console) : console_(console) {}
  ~BodyCache();
  BodyCache(const BodyCache&) = delete;
  BodyCache& operator=(const BodyCache&) = delete;

  /// @throws as make_mesh() and modes_of_mesh() do; a failure is not kept.
  Body body(const Study& study, BodyUse use);

  /// Modes of the study's substructures, without shapes.
  using StructurePieces = std::shared_ptr<const Pieces>;
  /// @throws as substructures_of() and fe_modal::analyse_modes() do.
  StructurePieces pieces(const Study& study);

  /// Computes figures of the modes with their derivatives, on the thread of the solvers; only the
  /// mesh is kept. @throws as flexneck::pipeline::modes_slopes() does.
  FigureSlopes slopes(const Study& study, BodyUse use, const std::vector<MovedStudy>& moved,
                      const std::vector<std::string>& figures);

  /// Starts PETSc, which changes environment variables: call it before other threads begin.
  void start();

  /// Number of modal analyses so far.
  std::size_t solved_count() const;

 private:
  /// The most recently used things by their keys, with the files that were read for them.
  template <class Thing>
  class Last {
   public:
    explicit Last(std::size_t count) : count_(count) {}
    /// Finds a thing and records its files as read, since the caller depends on them.
    const Thing* find(const std::string& key);
    void keep(const std::string& key, Thing thing, const FilesRead& reads);

   private:
    struct Entry {
      std::string key;
      Thing thing;
      std::vector<FileRead> reads;
    };
    using Entries = std::list<Entry>;
    std::size_t count_;
    Entries entries_;  ///< most recently used first
    std::map<std::string, typename Entries::iterator> places_;
  };

  Body known(const std::string& key);
  /// Called on the thread of the solvers only, as is solved().
  const mesher::Mesh& mesh_of(const Study& study);
  fe_modal::ModalBody solved(const Study& study, BodyUse use);

  const Console& console_;
  mutable std::mutex mutex_;  ///< guards bodies_ and solved_
  Last<Body> bodies_{kBodies};
  std::size_t solved_ = 0;
  Last<StructurePieces> pieces_{kPieces};          ///< used on the thread of the solvers only
  Last<mesher::Mesh> meshes_{kMeshes};             ///< used on the thread of the solvers only
  std::optional<fe_modal::PetscSession> session_;  ///< used on the thread of the solvers only
  SerialThread solvers_;  ///< declared last: its work uses the other members
};

}  // namespace flexneck::pipeline
