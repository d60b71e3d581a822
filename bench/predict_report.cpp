// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <filesystem>
#include <numeric>
#include <sstream>

#include "campaign.hpp"
#include "statistics.hpp"
#include "table.hpp"

namespace lrrt::bench {
namespace {

constexpr std::array<const char*, 4> stages = {"encode", "infer", "region", "all"};

/// The times of one stage in a row, milliseconds, sorted.
std::vector<double> times_of(const Json& row, std::size_t stage) {
  std::vector<double> times;
  for (const Json& call : row.at("times")) times.push_back(call.at(stage).get<double>());
  std::sort(times.begin(), times.end());
  return times;
}

/// The sides of the network's pictures in a row, each followed by `unit`.
std::string sides_of(const Json& row, const std::string& separator, const std::string& unit) {
  std::string text;
  for (const Json& side : row.at("input_sides")) {
    text += (text.empty() ? "" : separator) + std::to_string(side.get<int>()) + unit;
  }
  return text;
}

double per_second(const std::vector<double>& times) {
  const double total = std::accumulate(times.begin(), times.end(), 0.0);
  return 1e3 * static_cast<double>(times.size()) / total;
}

}  // namespace

std::string predict_report(const Json& document) {
  Table table(
      {"model", "map", "input", "threads", "spinning", "batch", "encode", "infer", "region", "all", "per second"});
  for (const Json& row : document.at("rows")) {
    const std::string side = std::to_string(row.at("size").get<int>());
    const std::filesystem::path model(row.at("model").get<std::string>());
    std::vector<std::string> cells = {model.filename().string(),
                                      side + "²",
                                      sides_of(row, ", ", "²"),
                                      std::to_string(row.at("threads").get<int>()),
                                      row.at("spinning").get<bool>() ? "on" : "off",
                                      std::to_string(row.at("batch").get<int>())};
    for (std::size_t stage = 0; stage < stages.size(); ++stage) {
      const std::vector<double> times = times_of(row, stage);
      cells.push_back(short_number(quantile(times, 0.5)) + " (" + short_number(quantile(times, 0.95)) + ")");
    }
    cells.push_back(short_number(per_second(times_of(row, 3))));
    table.add(std::move(cells));
  }
  return "Milliseconds a prediction: median (95 % are below); of a batch, infer and all are shares. Per second: "
         "predictions, calls one after the other, all stages. Input: sides of the network's pictures.\n" +
         table.text();
}

std::string predict_csv(const Json& document) {
  std::ostringstream text;
  text << "model,name,input_size,input_sides,size,threads,spinning,batch,predictions";
  for (const char* stage : stages) text << ',' << stage << "_median_ms," << stage << "_p95_ms";
  text << ",per_second\n";
  for (const Json& row : document.at("rows")) {
    text << quoted(row.at("model").get<std::string>()) << ',' << quoted(row.at("name").get<std::string>());
    text << ',' << row.at("input_size") << ',' << sides_of(row, " ", "");
    for (const char* key : {"size", "threads", "spinning", "batch"}) text << ',' << row.at(key);
    text << ',' << row.at("times").size();
    for (std::size_t stage = 0; stage < stages.size(); ++stage) {
      const std::vector<double> times = times_of(row, stage);
      text << ',' << quantile(times, 0.5) << ',' << quantile(times, 0.95);
    }
    text << ',' << per_second(times_of(row, 3)) << '\n';
  }
  return text.str();
}

}  // namespace lrrt::bench
