#include "bsdf/batch/detail/rows.h"

#include <algorithm>

#include <fmt/core.h>
#include <fmt/ranges.h>

namespace cuticle::bsdf::batch {
namespace {

struct Column {
  std::string name;
  float constant;
};

std::vector<Column> columns_of(const Model& model, const registry::ParameterValues& values, std::size_t count) {
  std::vector<Column> columns;
  for (const registry::Parameter& parameter : model.entry.parameters) {
    const std::string name(parameter.name);
    if (parameter.type == registry::ParameterType::real) columns.push_back({name, float(values.real(name))});
    if (parameter.type == registry::ParameterType::rgb)
      for (int c = 0; c < 3; ++c)
        columns.push_back(
            {fmt::format("{}.{}", name, std::string_view("rgb")[std::size_t(c)]), float(values.rgb(name)[c])});
  }
  columns.resize(std::min(columns.size(), count));
  return columns;
}

}  // namespace

Result<RowColumns> RowColumns::make(const Model& model, const registry::ParameterValues& values, int numbers,
                                    std::span<const VaryingParameter> varying) {
  const std::vector<Column> columns = columns_of(model, values, std::size_t(numbers));
  std::vector<std::string_view> known;
  for (const Column& column : columns) known.push_back(column.name);
  RowColumns rows;
  rows.count_ = columns.size();
  for (const Column& column : columns) rows.constants_.insert(rows.constants_.end(), row_block, column.constant);
  for (const VaryingParameter& parameter : varying) {
    const auto at = std::ranges::find(known, parameter.name);
    if (at == known.end())
      return usage_error(fmt::format("{} is not one of {}, which may vary", parameter.name, fmt::join(known, ", ")));
    rows.arrays_[std::size_t(at - known.begin())] = parameter.values;
  }
  return rows;
}

VaryingPointers RowColumns::block(std::size_t first) const {
  VaryingPointers pointers{{}, int(count_)};
  for (std::size_t k = 0; k < count_; ++k)
    pointers.value[k] = arrays_[k].empty() ? constants_.data() + k * row_block : arrays_[k].data() + first;
  return pointers;
}

}  // namespace cuticle::bsdf::batch
