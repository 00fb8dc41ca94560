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
#include "pipeline/console/console.h"
#include "pipeline/evaluation/modes_slopes.h"
#include "pipeline/evaluation/serial_thread.h"
#include "pipeline/evaluation/structure_modes.h"
#include "pipeline/model/piece_sections.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// Meshes and modes of studies that differ in some values, each computed once for all that have
/// the values it is made from in common. One at a time is computed, on a thread of its own, since
/// gmsh and PETSc serve one. The last kBodies bodies and kPieces sets of pieces, without shapes,
/// and kMeshes meshes are kept. For any number of threads. One at a time in a process, as
/// fe_modal::PetscSession.
class BodyCache {
 public:
  using Body = std::shared_ptr<const fe_modal::ModalBody>;
  static constexpr std::size_t kBodies = 2000;  ///< about 10 kB each
  static constexpr std::size_t kPieces = 200;   ///< about 100 kB each
  static constexpr std::size_t kMeshes = 4;

  /// @param console  for what meshing tells; outlives this
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

  /// Figures of the modes with their derivatives, on the thread of the solvers; nothing is kept but
  /// the mesh. @throws as flexneck::pipeline::modes_slopes() does.
  FigureSlopes slopes(const Study& study, BodyUse use, const std::vector<MovedStudy>& moved,
                      const std::vector<std::string>& figures);

  /// Starts PETSc, which changes variables of the environment: before other threads begin.
  void start();

  /// How often modes were computed.
  std::size_t solved_count() const;

 private:
  /// The last few things by their keys, with the files that were read for them.
  template <class Thing>
  class Last {
   public:
    explicit Last(std::size_t count) : count_(count) {}
    /// Whoever finds one depends on these files: they are noted as read.
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
    Entries entries_;  ///< the one used last first
    std::map<std::string, typename Entries::iterator> places_;
  };

  Body known(const std::string& key);
  /// On the thread of the solvers, both.
  const mesher::Mesh& mesh_of(const Study& study);
  fe_modal::ModalBody solved(const Study& study, BodyUse use);

  const Console& console_;
  mutable std::mutex mutex_;  ///< of the bodies
  Last<Body> bodies_{kBodies};
  std::size_t solved_ = 0;
  Last<StructurePieces> pieces_{kPieces};          ///< of the thread of the solvers
  Last<mesher::Mesh> meshes_{kMeshes};             ///< of the thread of the solvers
  std::optional<fe_modal::PetscSession> session_;  ///< likewise
  SerialThread solvers_;                           ///< last: it uses the others
};

}  // namespace flexneck::pipeline
