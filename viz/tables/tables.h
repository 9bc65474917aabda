#pragma once
// A view of lookup tables: each as image and as height field, beside its error. Needs no VTK.
#include <string>
#include <vector>

#include "lut/table_set.h"

namespace cuticle::viz {

struct TablesView {
  lut::TableSet set;
  std::string table;  ///< its name; empty: the first
};

/// The set in a folder that `bake` wrote, with the model and parameters that its manifest names. Error: bad_input
/// naming the file.
Result<lut::TableSet> read_tables(const std::string& folder);

/// One channel's numbers as a shader reads them, row 0 at the lower end of v.
struct TableChannel {
  std::string name, unit, u_title, v_title;
  double u_lower = 0, u_upper = 1, v_lower = 0, v_upper = 1;  ///< values of the axes at texture coordinates 0 and 1
  int width = 0, height = 0;
  std::vector<float> values;
  int error_width = 0, error_height = 0;
  std::vector<float> errors;  ///< table less model between texels, where bilinear filters err most; empty: not known
  double peak = 0;            ///< the channel's largest value
};
Result<std::vector<TableChannel>> table_channels(const TablesView& view);

/// Writes every channel of every table as TABLE.vti: point arrays of the channels' names. Error: bad_input.
Result<void> write_tables(const lut::TableSet& set, const std::string& folder);

}  // namespace cuticle::viz
