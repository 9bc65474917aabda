#pragma once
// The view of tables. Private to viz.
#include <memory>

#include "viz/draw/detail/parts.h"
#include "viz/draw/detail/plot.h"
#include "viz/tables/tables.h"
#include "viz/window/detail/view.h"

namespace cuticle::viz {

/// A row a channel: image, height field, error map. Three rows at a time.
class TablesPicture : public ViewOf<TablesView> {
 public:
  explicit TablesPicture(TablesView view) : ViewOf("lut", std::move(view)) {}
  Result<void> fill(const WindowArea& area) override;
  std::vector<Control> controls() override;
  void turn(double degrees) override;
  Result<std::string> pick(const glm::ivec2& pixel) override;
  Result<void> write_files(const std::string& folder) override;

 private:
  struct Row {
    std::unique_ptr<Plot> image, error;
    vtkSmartPointer<vtkRenderer> field;
    vtkSmartPointer<vtkProp> surface;
    std::size_t channel = 0;
  };
  void show_rows();
  void show(Row& row);
  void show_error(Row& row);
  Result<void> change_table(std::size_t index);
  std::string probe(const TableChannel& channel, const glm::dvec2& place) const;

  std::vector<TableChannel> channels_;
  std::vector<Row> rows_;
  std::size_t first_ = 0;
  double scale_ = 1;
};

}  // namespace cuticle::viz
