#include "core/registry/members.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cuticle::registry::members_test {
namespace {

enum class Order { sequence, red_black };
constexpr std::string_view k_orders[] = {"sequence", "red_black"};
constexpr Parameter k_damping = row("damping", "1/s", 0, 1000, "drag of still air");

struct Shared {
  double damping = 2;
};
struct Toy : Shared {
  double stiffness = 3.9e9;
  float radius = 3.5e-5f;
  std::uint32_t steps = 64;
  bool exact = true;
  Order order = Order::red_black;
  glm::dvec3 gravity{0, -9.80665, 0}, tint{0.2};
};
void describe(Members& members, Toy& toy) {
  members(toy.damping, k_damping);
  members(toy.stiffness, "stiffness", "Pa", 0, 1e20, "of the toy");
  members(toy.radius, "radius", "m", 0, 1, "of the toy");
  members(toy.steps, "steps", 1, 4096, "at most");
  members(toy.exact, "exact", "to the last digit");
  members(toy.order, "order", k_orders, "of a sweep");
  members(toy.gravity, "gravity", "m/s^2", -1000, 1000, "acceleration");
  members(toy.tint, "tint", "1", 0, 1, "colour");
}

TEST(Members, Table_HasARowPerMemberWithTheStructsDefaults) {
  std::vector<std::string> rows;
  for (const Parameter& p : table_of<Toy>())
    rows.push_back(std::string(p.name) + "=" + std::string(p.default_text) + " " + std::string(p.unit));
  EXPECT_THAT(rows,
              ::testing::ElementsAre("damping=2 1/s", "stiffness=3.9e9 Pa", "radius=3.5e-5 m", "steps=64 1",
                                     "exact=true 1", "order=red_black 1", "gravity=0/-9.80665/0 m/s^2", "tint=0.2 1"));
}

TEST(Members, Defaults_OfTheTable_AreThoseOfTheStruct) {
  const Toy read = from_values<Toy>(default_values(table_of<Toy>()));
  const Toy made;
  EXPECT_EQ(read.damping, made.damping);
  EXPECT_EQ(read.stiffness, made.stiffness);
  EXPECT_EQ(read.radius, made.radius);
  EXPECT_EQ(read.steps, made.steps);
  EXPECT_EQ(read.exact, made.exact);
  EXPECT_EQ(read.order, made.order);
  EXPECT_EQ(read.gravity, made.gravity);
  EXPECT_EQ(read.tint, made.tint);
}

TEST(Members, Values_AsTyped_AreTheMembers) {
  const Toy toy = from_values<Toy>(
      parse_assignments(table_of<Toy>(), "damping=0.5,radius=0.25,steps=7,exact=off,order=sequence,tint=0.1/0.2/0.3")
          .value());
  EXPECT_EQ(toy.damping, 0.5);
  EXPECT_EQ(toy.radius, 0.25f);
  EXPECT_EQ(toy.steps, 7u);
  EXPECT_FALSE(toy.exact);
  EXPECT_EQ(toy.order, Order::sequence);
  EXPECT_EQ(toy.tint, glm::dvec3(0.1, 0.2, 0.3));
}

TEST(Members, Struct_WrittenAndRead_IsTheSame) {
  Toy toy;
  toy.order = Order::sequence;
  toy.steps = 3;
  const ParameterValues values = to_values(toy);
  EXPECT_EQ(values.choice("order"), "sequence");
  EXPECT_EQ(values_from_json(table_of<Toy>(), to_json(values), "toy").value(), values);
  EXPECT_EQ(from_values<Toy>(values).steps, 3u);
}

TEST(Members, FloatMember_InValues_IsTheDecimalThatWasMeant) { EXPECT_EQ(to_values(Toy{}).real("radius"), 3.5e-5); }

constexpr std::string_view k_storages[] = {"words", "bytes"}, k_methods[] = {"traced", "voxel"};
struct Named {
  bool bytes = false;
  double bias = 4e-3;
  std::string method = "traced";
};
void describe(Members& members, Named& named) {
  members(named.bytes, "storage", k_storages, "of a map");
  members.millimetres(named.bias, "bias_mm", 0, 1000, "of a map");
  members(named.method, "method", k_methods, "of a shadow");
}

TEST(Members, NamedBooleanMillimetresAndNames_AsTyped_AreTheMembers) {
  const ParameterTable table = table_of<Named>();
  EXPECT_EQ(table[0].default_text, "words");
  EXPECT_EQ(table[1].default_text, "4");
  EXPECT_EQ(table[2].default_text, "traced");
  const Named named = parse<Named>("storage=bytes,bias_mm=2,method=voxel").value();
  EXPECT_TRUE(named.bytes);
  EXPECT_EQ(named.bias, 1e-3 * 2);
  EXPECT_EQ(named.method, "voxel");
  EXPECT_FALSE(parse<Named>("storage=halves"));
}

}  // namespace
}  // namespace cuticle::registry::members_test
