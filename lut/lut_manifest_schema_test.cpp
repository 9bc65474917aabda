// The published schema and the reader take and refuse the same manifests.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "core/file.h"
#include "lut/format.h"
#include "lut/manifest.h"
#include "lut/table_set.h"

namespace cuticle::lut::lut_manifest_schema_test {
namespace {

using nlohmann::json;

bool schema_accepts(const json& manifest) {
  static const json text = json::parse(read_text_file(CUTICLE_SOURCE_DIR "/docs/lut_manifest.schema.json").value());
  static const auto schema = [] {
    auto parsed = std::make_unique<valijson::Schema>();
    valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(text), *parsed);
    return parsed;
  }();
  return valijson::Validator().validate(*schema, valijson::adapters::NlohmannJsonAdapter(manifest), nullptr);
}

bool reader_accepts(const json& manifest) { return parse_manifest(manifest.dump(), "manifest.json").ok(); }

json baked_manifest(const char* layout, const Format& format) {
  const bsdf::Model& model = *bsdf::find_model("marschner").value();
  TableSet set =
      bake(model, registry::default_values(model.entry.parameters), *find_layout(layout).value(), 16, silent_progress())
          .value();
  EXPECT_TRUE(store_as(set, format).ok());
  return json::parse(manifest_json(set, format));
}

TEST(ManifestSchema, WhatBakeWrites_IsTakenByBoth) {
  for (const char* layout : {"nalu", "nalu2", "nalu_theta", "nalu_caustic", "realengine"})
    for (const Format* format : formats()) {
      const json manifest = baked_manifest(layout, *format);
      EXPECT_TRUE(schema_accepts(manifest)) << layout << " " << format->name;
      EXPECT_TRUE(reader_accepts(manifest)) << layout << " " << format->name;
    }
}

struct Change {
  const char* pointer;
  json value;  ///< null: the key is removed
};

TEST(ManifestSchema, AnyWrongKey_IsRefusedByBoth) {
  const json right = baked_manifest("nalu", half_exr());
  for (const Change& change : {Change{"/schema_version", 1},
                               {"/tool_version", nullptr},
                               {"/model", "a b"},
                               {"/origin", "bottom_left"},
                               {"/format", "tga"},
                               {"/tables", json::array()},
                               {"/tables/0/file", "a/b"},
                               {"/tables/0/size", {1, 2, 3}},
                               {"/tables/0/size/1", 2.5},
                               {"/tables/0/u/bias", nullptr},
                               {"/tables/0/u/address_mode", "wrap"},
                               {"/tables/0/channels/0/name", ".x"},
                               {"/tables/0/channels/0/maximum", -1},
                               {"/tables/0/probes/0/at", "here"},
                               {"/tables/0/probes/0/v", 2},
                               {"/terms", "none"},
                               {"/over_cos2_theta_d", 1}}) {
    json wrong = right;
    const json::json_pointer at(change.pointer);
    if (change.value.is_null())
      wrong[at.parent_pointer()].erase(at.back());
    else
      wrong[at] = change.value;
    EXPECT_FALSE(schema_accepts(wrong)) << change.pointer;
    EXPECT_FALSE(reader_accepts(wrong)) << change.pointer;
  }
}

}  // namespace
}  // namespace cuticle::lut::lut_manifest_schema_test
