/// Morph targets and skins: what the vertices of a primitive become before anything else is done with them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/scene.h"
#include "io/gltf_accessor.h"

namespace tinygltf {
struct Mesh;
class Node;
struct Primitive;
}  // namespace tinygltf

namespace candil {

class Warnings;

/// How a node bends the mesh that it shows.
struct Deformation {
  std::vector<float> weights;  ///< Of the morph targets; empty: none of them counts.
  /// Of the skin: from the mesh's space to the world for each joint, if it has one.
  const std::vector<Affine>* joints = nullptr;
  Affine node_to_world;  ///< Places the primitives of a skinned mesh that no joint holds.

  bool is_none() const { return weights.empty() && joints == nullptr; }
};

/// The weights of the morph targets of the mesh that the node shows (specification, section 3.7.2.2): its own, else
/// the mesh's, one for each target; empty when all are 0.
std::vector<float> morph_weights(const tinygltf::Node& node, const tinygltf::Mesh& mesh, const std::string& place,
                                 Warnings& warnings);

/// From the bind pose to the world, for each joint of skins[index]: the joint's global transform after its inverse bind
/// matrix. `to_world` has the global transform of every node. Throws InputError when there are too few matrices.
std::vector<Affine> joint_transforms(const GltfDocument& document, std::size_t index,
                                     const std::vector<Affine>& to_world, Warnings& warnings);

/// A primitive in the file, at `place`, and those of its vertices that the mesh has.
struct PrimitiveSource {
  const GltfDocument& document;
  const tinygltf::Primitive& primitive;
  const std::string& place;
  const VertexSelection& selection;
};

/// Throws InputError unless every target has as many elements as the primitive has vertices.
void check_morph_targets(const PrimitiveSource& source);

/// Bends a mesh whose attributes are as in the file: adds the displacements of the targets to all its attributes, then
/// moves positions, normals and tangents with their joints. Neither unit length nor range of the result is certain.
/// Throws InputError for what the targets, joints and weights do not say properly.
void deform(const PrimitiveSource& source, const Deformation& deformation, Mesh& mesh, Warnings& warnings);

}  // namespace candil
