// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/foundation/names.h"
#include "multibody/forces/bushing.h"
#include "multibody/forces/cable.h"
#include "multibody/forces/force_element.h"
#include "multibody/forces/function_force.h"
#include "multibody/forces/joint_resistance.h"
#include "multibody/forces/line_force.h"
#include "multibody/forces/marker_spring.h"
#include "multibody/forces/point_force.h"
#include "multibody/forces/section.h"
#include "multibody/forces/torque.h"

namespace flexneck::multibody {

/// Force elements, one list for each kind. Kinds are known at compile time, so that a loop over all
/// of them calls each one's functions directly.
template <ForceElement... Kinds>
class ForceLists {
 public:
  /// Tuple with one item for each kind, e.g. data of its elements.
  template <template <class> class Of>
  using OfEachKind = std::tuple<Of<Kinds>...>;

  template <ForceElement Kind>
  std::vector<Kind>& of() {
    return std::get<std::vector<Kind>>(lists_);
  }
  template <ForceElement Kind>
  const std::vector<Kind>& of() const {
    return std::get<std::vector<Kind>>(lists_);
  }

  template <ForceElement Kind>
  void add(Kind element) {
    of<Kind>().push_back(std::move(element));
  }

  /// Calls visit(std::vector<Kind>) for each kind, in the order of their list.
  template <class Visit>
  void each_kind(Visit&& visit) const {
    (visit(of<Kinds>()), ...);
  }

  /// @throws InputError naming an element that is invalid or whose name is taken.
  void check(const ForceSites& sites) const {
    each_kind([&]<class Kind>(const std::vector<Kind>& elements) {
      check_names(names_of(elements), std::string(Kind::kName));
      for (const Kind& element : elements) element.check(title(element), sites);
    });
  }

 private:
  std::tuple<std::vector<Kinds>...> lists_;
};

/// The force elements of a model, of all kinds. A new kind is a header of its own (ForceElement)
/// and a row here.
using Forces = ForceLists<PointForce,       // [[force]] in model files
                          Torque,           // [[torque]]
                          MarkerSpring,     // [[spring]]
                          Bushing,          // [[bushing]]
                          JointResistance,  // [[resistance]]
                          LineForce,        // [[line_force]]
                          Section,          // [[section]]
                          FunctionForce,    // [[function_force]]
                          Cable>;           // [[cable]]

}  // namespace flexneck::multibody
