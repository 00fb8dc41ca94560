// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/distributed/share_message.h"

#include <array>
#include <utility>

namespace flexneck::fe_modal {

Bytes pack(const Share& share) {
  MessageWriter message;
  message.put(share.mesh.nodes);
  message.put(share.mesh.materials.size());
  for (const mesher::Material& material : share.mesh.materials) {
    message.put(material.name);
    message.put(material.youngs_modulus_Pa);
    message.put(material.poissons_ratio);
    message.put(material.density_kg_m3);
    message.put(share.formulation.of(material));
  }
  message.put(share.mesh.blocks.size());
  for (const mesher::ElementBlock& block : share.mesh.blocks) {
    message.put(block.part);
    message.put(block.kind);
    message.put(block.material);
    message.put(block.nodes);
  }
  message.put(share.nodes);
  message.put(share.free_index);
  message.put(share.free_global);
  return message.bytes();
}

Share unpack_share(Bytes bytes) {
  MessageReader message(std::move(bytes));
  Share share;
  share.mesh.nodes = message.list<std::array<double, 3>>();
  share.mesh.materials.resize(message.get<std::size_t>());
  for (mesher::Material& material : share.mesh.materials) {
    material.name = message.text();
    material.youngs_modulus_Pa = message.get<double>();
    material.poissons_ratio = message.get<double>();
    material.density_kg_m3 = message.get<double>();
    share.formulation.of_material[material.name] = message.get<Formulation>();
  }
  share.mesh.blocks.resize(message.get<std::size_t>());
  for (mesher::ElementBlock& block : share.mesh.blocks) {
    block.part = message.text();
    block.kind = message.get<mesher::ElementKind>();
    block.material = message.get<std::size_t>();
    block.nodes = message.list<std::int32_t>();
  }
  share.nodes = message.list<std::int32_t>();
  share.free_index = message.list<std::int32_t>();
  share.free_global = message.list<std::int32_t>();
  return share;
}

}  // namespace flexneck::fe_modal
