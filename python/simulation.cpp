// A strand solver step by step.
#include <cmath>

#include <fmt/format.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "core/json/json.h"
#include "core/registry/read_json.h"
#include "sim/colliders/distance_field.h"
#include "sim/control/control.h"
#include "sim/rod/equilibrium.h"
#include "sim/rod/hold.h"
#include "sim/solver.h"
#include "sim/telemetry.h"
#include "strands/formats/formats.h"

#include "python/arrays.h"
#include "python/groom_file.h"
#include "python/mesh.h"
#include "python/signals.h"

namespace cuticle::python {
namespace {

using strands::GroomFile;

Result<sim::EffectBlocks> parse_effects(const std::string& json) {
  CUTICLE_ASSIGN(const Json object, Json::parse(json));
  sim::EffectBlocks blocks;
  for (const auto& [name, parameters] : object.items()) {
    CUTICLE_ASSIGN(const sim::Effect* effect, sim::find_effect(name));
    if (effect->create) return usage_error(fmt::format("effects: '{}' is a solver", name), "solver=\"" + name + "\"");
    CUTICLE_ASSIGN(blocks[name], registry::values_from_object(effect->entry.parameters, parameters, "effects." + name));
  }
  return blocks;
}

glm::dmat4 matrix_of(const Numbers& rows) {
  if (rows.ndim() != 2 || rows.shape(0) != 4 || rows.shape(1) != 4) raise(usage_error("head: not an array of 4 x 4"));
  glm::dmat4 matrix;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) matrix[column][row] = rows.data()[4 * row + column];
  return matrix;
}

/// Of rows (x, y, z, radius).
std::vector<Sphere> spheres_of(const Numbers& rows) {
  std::vector<Sphere> spheres;
  for (const glm::dvec4& row : rows_of<glm::dvec4>(rows, "spheres")) spheres.push_back({glm::dvec3(row), row.w});
  return spheres;
}

class Simulation {
 public:
  Simulation(const GroomFile& rest, const std::string& solver, const std::string& settings, const std::string& effects)
      : rest_(rest.groom), effect_(value_or_raise(sim::find_effect(solver))) {
    if (!effect_->create)
      raise(usage_error(fmt::format("solver: '{}' is an effect", solver), "effects={\"" + solver + "\": {}}"));
    values_ = value_or_raise(registry::values_from_json(effect_->entry.parameters, settings, solver));
    effects_ = value_or_raise(parse_effects(effects));
    reset();
  }

  void reset() {
    sim::EffectBlocks of_solver = effects_;
    const auto control = sim::find_effect<sim::control::Control>(effects_);
    solver_ = value_or_raise(effect_->create(rest_, values_, of_solver));
    if (control) solver_ = sim::control::controlled(std::move(solver_), rest_, *control);
    head_ = glm::dmat4(1);
    time_ = 0;
    moving_from_.clear();
  }

  /// As many equal steps as are asked for; the head and the moving spheres go on from where they were.
  void step(double duration, int count, const Numbers& head, bool teleport, const nb::object& call) {
    const glm::dmat4 begin = head_, end = matrix_of(head);
    if (count < 1) raise(usage_error(fmt::format("count: {} is below 1", count)));
    CalledProgress progress(call);
    for (int k = 0; k < count; ++k) {
      advance(duration, k == 0 ? begin : end, end, teleport && k == 0);
      progress.update("simulate", std::size_t(k) + 1, std::size_t(count));
    }
  }

  /// Beside those given: `authored` (world places) and `weights`, of the effect "control"; empty: none.
  void set_authored(const Floats& authored, const Floats& weights) {
    authored_ = rows_of<glm::vec3>(authored, "authored");
    weights_ = rows_of<float>(weights, "weights");
  }
  void set_spheres(const Numbers& rows) { spheres_ = spheres_of(rows); }
  void set_capsules(const Numbers& rows) {
    if (rows.ndim() != 2 || rows.shape(1) != 7) raise(usage_error("capsules: not rows of x, y, z, x, y, z, radius"));
    boxes_.clear();
    for (std::size_t i = 0; i < rows.shape(0); ++i) {
      const double* n = rows.data() + 7 * i;
      boxes_.push_back(make_capsule({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, n[6]));
    }
  }
  void add_mesh(const Floats& positions, const Indices& triangles, double spacing) {
    const strands::Mesh mesh = mesh_of(positions, triangles);
    auto field = value_or_raise(sim::bake_distance_field(mesh, spacing, "collider"));
    fields_.push_back(std::make_shared<const sim::DistanceField>(std::move(field)));
  }
  void clear_meshes() { fields_.clear(); }
  /// World places at the end of the next step; they move there from where they were, evenly.
  void set_moving(const Numbers& rows) {
    moving_ = spheres_of(rows);
    if (moving_from_.size() != moving_.size()) moving_from_ = moving_;
  }

  /// Places, and arrays with a number per strand, by name.
  nb::dict at_rest(const nb::object& call) {
    if (effect_->entry.name != "rod")
      raise(usage_error(fmt::format("at_rest: solver '{}' has no equilibrium of its own", effect_->entry.name),
                        "solver=\"rod\""));
    CalledProgress progress(call);
    const std::vector<sim::PlacedCollider> colliders =
        sim::placed_colliders({.colliders = spheres_, .boxes = boxes_, .fields = fields_});
    auto found =
        value_or_raise(sim::rod::find_equilibrium(rest_, values_, effects_, {.colliders = colliders}, progress));
    const auto holds = value_or_raise(sim::rod::find_holds(rest_, values_, effects_));
    strands::Groom groom = rest_;
    groom.positions = std::move(found.positions);
    nb::dict result;
    result["groom"] = in_file(std::move(groom));
    const auto put = [&](const char* name, auto&& of_strand) {
      std::vector<float> numbers;
      for (std::size_t s = 0; s < holds.size(); ++s) numbers.push_back(float(of_strand(s)));
      const std::size_t count = numbers.size();
      result[name] = take(std::move(numbers), {count});
    };
    put("residual", [&](std::size_t s) { return found.strands[s].residual; });
    put("steps", [&](std::size_t s) { return found.strands[s].steps; });
    put("depth", [&](std::size_t s) { return found.strands[s].depth; });
    put("balanced", [&](std::size_t s) { return found.strands[s].is_balanced; });
    put("stable", [&](std::size_t s) { return found.strands[s].is_stable; });
    put("stiffening", [&](std::size_t s) { return holds[s].stiffening; });
    put("held", [&](std::size_t s) { return holds[s].is_stable; });
    return result;
  }

  sim::State state() { return value_or_raise(solver_->state()); }
  GroomFile groom() {
    strands::Groom moved = rest_;
    moved.positions = state().positions;
    return in_file(std::move(moved));
  }
  double time() const { return time_; }
  const strands::Groom& rest() const { return rest_; }

 private:
  std::vector<sim::MovingCollider> moving_colliders(double duration) const {
    std::vector<sim::MovingCollider> colliders;
    for (std::size_t i = 0; i < moving_.size(); ++i) {
      KeyedMotion motion{
          {{time_, {.position = moving_from_[i].center}}, {time_ + duration, {.position = moving_[i].center}}}};
      colliders.push_back({.shape = Sphere{glm::dvec3(0), moving_[i].radius}, .motion = std::move(motion)});
    }
    return colliders;
  }

  void advance(double duration, const glm::dmat4& begin, const glm::dmat4& end, bool teleport) {
    const auto moving = moving_colliders(duration);
    const sim::FrameInput input{.duration = duration,
                                .head_begin = begin,
                                .head_end = end,
                                .colliders = spheres_,
                                .boxes = boxes_,
                                .fields = fields_,
                                .moving = moving,
                                .clock_begin = time_,
                                .clock_end = time_ + duration,
                                .teleport = teleport,
                                .authored = authored_,
                                .control = weights_};
    const Result<void> done = [&] {
      const nb::gil_scoped_release released;
      return solver_->advance(input);
    }();
    require(done);
    head_ = end;
    time_ += duration;
    moving_from_ = moving_;
  }

  strands::Groom rest_;
  const sim::Effect* effect_;
  registry::ParameterValues values_;
  sim::EffectBlocks effects_;
  std::unique_ptr<sim::Solver> solver_;
  glm::dmat4 head_{1};
  double time_ = 0;
  std::vector<Sphere> spheres_, moving_, moving_from_;
  std::vector<RoundedBox> boxes_;
  std::vector<sim::FieldPointer> fields_;
  std::vector<glm::vec3> authored_;
  std::vector<float> weights_;
};

template <class T, auto Member>
auto view(nb::handle self) {
  return view_of<T>(self, nb::cast<sim::State&>(self).*Member);
}

void add_state(nb::module_& module) {
  using sim::State;
  nb::class_<State>(module, "State", "Control hairs at the end of a step, world space; the arrays are views.")
      .def_prop_ro("positions", &view<float, &State::positions>, "float32 (vertices, 3), metres")
      .def_prop_ro("velocities", &view<float, &State::velocities>, "float32 (vertices, 3), metres per second")
      .def_prop_ro("tensions", &view<float, &State::tensions>,
                   "float32 (vertices): tension over mass per length towards the root, m^2/s^2; empty of 'classic'")
      .def_prop_ro(
          "resets",
          [](nb::handle self) {
            const std::vector<std::uint32_t>& resets = nb::cast<sim::State&>(self).resets;
            return nb::ndarray<nb::numpy, const std::uint32_t>(resets.data(), {resets.size()}, self);
          },
          "uint32 (strands): 1 where a strand is one of guards_fired")
      .def_ro("guards_fired", &State::guards_fired, "strands reset in the step because something was not finite")
      .def_ro("left_out", &State::left_out, "vertices that strand_interaction could not count")
      .def_ro("asleep", &State::asleep, "strands that 'sleep' leaves as they are")
      .def("copy", [](const State& state) { return state; });
}

}  // namespace

void add_simulation(nb::module_& module) {
  add_state(module);
  nb::class_<Simulation>(module, "Simulation")
      .def(nb::init<const GroomFile&, const std::string&, const std::string&, const std::string&>())
      .def("reset", &Simulation::reset)
      .def("step", &Simulation::step, nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg().none())
      .def("set_authored", &Simulation::set_authored)
      .def("set_spheres", &Simulation::set_spheres)
      .def("set_capsules", &Simulation::set_capsules)
      .def("set_moving", &Simulation::set_moving)
      .def("add_mesh", &Simulation::add_mesh)
      .def("clear_meshes", &Simulation::clear_meshes)
      .def("at_rest", &Simulation::at_rest, nb::arg().none())
      .def("state", &Simulation::state)
      .def("groom", &Simulation::groom)
      .def("time", &Simulation::time)
      .def("stretch",
           [](Simulation& of) {
             std::vector<float> stretch = sim::stretch(of.rest(), of.state().positions);
             const std::size_t count = stretch.size();
             return take(std::move(stretch), {count});
           })
      .def("curvature", [](Simulation& of) {
        std::vector<float> curvature = sim::curvature(of.rest(), of.state().positions);
        const std::size_t count = curvature.size();
        return take(std::move(curvature), {count});
      });
}

}  // namespace cuticle::python
