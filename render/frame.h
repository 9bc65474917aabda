#pragma once
// The resources of a frame that live on a device, by name: what a pass may say that it reads or writes. Those that one
// pass writes for others stand in its own folder.
#include "render/resource.h"

namespace cuticle::render {

struct PosedCharacter;
constexpr std::string_view resource_name(const PosedCharacter*) { return "posed_character"; }
struct HeadVertices;
constexpr std::string_view resource_name(const HeadVertices*) { return "head_vertices"; }
struct FinVertices;
constexpr std::string_view resource_name(const FinVertices*) { return "fin_vertices"; }
struct ControlHairs;
constexpr std::string_view resource_name(const ControlHairs*) { return "control_hairs"; }
struct StrandMaker;
constexpr std::string_view resource_name(const StrandMaker*) { return "strand_maker"; }
struct SmoothedHairs;
constexpr std::string_view resource_name(const SmoothedHairs*) { return "smoothed_hairs"; }
struct DrawnHair;
constexpr std::string_view resource_name(const DrawnHair*) { return "drawn_hair"; }
struct DrawnVelocities;
constexpr std::string_view resource_name(const DrawnVelocities*) { return "drawn_velocities"; }
struct HairTransmittance;
constexpr std::string_view resource_name(const HairTransmittance*) { return "hair_transmittance"; }
struct Targets;
constexpr std::string_view resource_name(const Targets*) { return "targets"; }
struct Output;
constexpr std::string_view resource_name(const Output*) { return "output"; }
struct SeenHair;
constexpr std::string_view resource_name(const SeenHair*) { return "seen_hair"; }

/// What of the targets is drawn: surfaces first, then strands, whose pass may look at the surfaces' depth.
struct DrawnSurfaces;
constexpr std::string_view resource_name(const DrawnSurfaces*) { return "drawn_surfaces"; }
struct StrandPixels;
constexpr std::string_view resource_name(const StrandPixels*) { return "strand_pixels"; }
/// The targets' depth, by a kernel, sample by sample.
struct TargetDepth;
constexpr std::string_view resource_name(const TargetDepth*) { return "target_depth"; }
/// Velocities of what a pixel sees.
struct SeenVelocities;
constexpr std::string_view resource_name(const SeenVelocities*) { return "seen_velocities"; }

}  // namespace cuticle::render
