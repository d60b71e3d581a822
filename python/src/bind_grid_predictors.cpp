// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.hpp"
#include "lrrt/error.hpp"
#include "lrrt/predict/grid_predictors.hpp"
#include "lrrt/predict/refined_predictor.hpp"

namespace lrrt::python {

void bind_grid_predictors(py::module_& module) {
  py::class_<GivenRegion, RegionPredictor, std::shared_ptr<GivenRegion>>(module, "GivenRegion",
                                                                         "A region that the caller already has.")
      .def(py::init([](const DenseArray<float>& probability, float threshold) {
             if (probability.ndim() != 2) throw RequestError("a region is an (H, W) array of probabilities");
             return std::make_shared<GivenRegion>(
                 static_cast<int>(probability.shape(1)), static_cast<int>(probability.shape(0)),
                 std::vector<float>(probability.data(), probability.data() + probability.size()), threshold);
           }),
           py::arg("probability"), py::arg("threshold") = 0.5F,
           "(H, W) probabilities or a bool mask, as large as the maps that will be planned on.");
  py::class_<AStarPredictor, RegionPredictor, std::shared_ptr<AStarPredictor>>(
      module, "AStarPredictor", "The neighbourhood of the shortest grid path (A*-RRT*).")
      .def(py::init<double>(), py::arg("radius") = 5.0, "`radius`: half the width of the region, pixels.");
  py::class_<PotentialFieldPredictor, RegionPredictor, std::shared_ptr<PotentialFieldPredictor>>(
      module, "PotentialFieldPredictor", "The way that an artificial potential field goes; for comparison.")
      .def(py::init<double, double>(), py::arg("radius") = 5.0, py::arg("reach") = 8.0,
           "`radius`: half the width of the region; `reach`: distance up to which obstacles push; both in pixels.");
  py::class_<RefinedPredictor, RegionPredictor, std::shared_ptr<RefinedPredictor>>(
      module, "RefinedPredictor", "Predicts twice: the whole map, then the parts of it along the way that shows.")
      .def(py::init([](std::shared_ptr<RegionPredictor> predictor, int window, int most_windows) {
             return std::make_shared<RefinedPredictor>(std::move(predictor), RefineOptions{window, most_windows});
           }),
           py::arg("predictor"), py::arg("window") = RefineOptions{}.window,
           py::arg("most_windows") = RefineOptions{}.most_windows,
           "`window`: side of the parts, pixels; where more than `most_windows` are needed the region stays as it is.");
}

}  // namespace lrrt::python
