// SPDX-License-Identifier: BSD-3-Clause
#include "suite.hpp"
#include "number_rules.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

namespace lrrt::bench {
namespace {

namespace fs = std::filesystem;

constexpr NumberRule sides{16, 16384, "a side from 16 to 16384 pixels"};
constexpr NumberRule threads_rule{1, 1024, "a number of threads from 1 to 1024"};
constexpr NumberRule batches{1, 4096, "a number of predictions from 1 to 4096"};
constexpr std::uintmax_t longest_suite = 1 << 20;  // bytes

/// Settings that lists combine to are held in memory, and so is all of a call.
void check_settings(const Fields& fields, const PredictSuite& suite) {
  constexpr std::uint64_t most_settings = 10'000;
  constexpr std::int64_t most_pixels = std::int64_t{1} << 28;
  std::uint64_t settings = 1;
  for (const std::size_t values :
       {suite.models.size(), suite.sizes.size(), suite.threads.size(), suite.batch.size(), suite.spinning.size()}) {
    settings *= values;
    if (settings <= most_settings) continue;
    fields.refuse_all("the lists 'models', 'sizes', 'threads', 'batch' and 'spinning' combine to more than " +
                      std::to_string(most_settings) + " settings: expected shorter lists");
  }
  const std::int64_t side = *std::max_element(suite.sizes.begin(), suite.sizes.end());
  if (*std::max_element(suite.batch.begin(), suite.batch.end()) <= most_pixels / (side * side)) return;
  fields.refuse("batch", "calls of at most " + std::to_string(most_pixels) + " pixels, 'batch' times 'sizes' squared");
}

PredictSuite read_predict_suite(const Fields& fields) {
  fields.allow_only(
      {"kind", "title", "models", "sizes", "threads", "batch", "spinning", "level", "mazes", "runs", "seed"});
  PredictSuite suite;
  suite.models = fields.texts("models", suite.models);
  suite.sizes = fields.counts("sizes", suite.sizes, sides);
  suite.threads = fields.counts("threads", suite.threads, threads_rule);
  suite.batch = fields.counts("batch", suite.batch, batches);
  suite.spinning = fields.flags("spinning", suite.spinning);
  suite.level = static_cast<int>(fields.count("level", suite.level, levels));
  suite.mazes = static_cast<int>(fields.count("mazes", suite.mazes, counts));
  suite.runs = static_cast<int>(fields.count("runs", suite.runs, counts));
  suite.seed = fields.seed("seed", suite.seed);
  check_settings(fields, suite);
  if (suite.level % 2 == 0) fields.refuse("level", levels.expected);
  if (suite.level > *std::min_element(suite.sizes.begin(), suite.sizes.end())) {
    fields.refuse("level", "no more blocks than the smallest of sizes has pixels");
  }
  check_pixels(fields, "mazes", suite.mazes, *std::max_element(suite.sizes.begin(), suite.sizes.end()));
  return suite;
}

/// The line at which a second document begins, from 1 on; 0 where there is none. YAML::LoadAll would tell, but hangs on
/// some texts that are no YAML. Within any value of YAML no line begins so.
std::size_t second_document(const std::string& text) {
  std::istringstream lines(text);
  bool begun = false;
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    const bool marker =
        line.substr(0, 3) == "---" && (line.size() == 3 || std::isspace(static_cast<unsigned char>(line[3])) != 0);
    if (marker && begun) return number;
    const std::size_t first = line.find_first_not_of(" \t\r");
    begun = begun || marker || (first != std::string::npos && line[first] != '#' && line[first] != '%');
  }
  return 0;
}

YAML::Node parsed(const std::string& text, const std::string& file) {
  if (const std::size_t line = second_document(text); line != 0) {
    throw SuiteError(file + ":" + std::to_string(line) + ": begins another document: expected one suite a file");
  }
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw SuiteError(file + ":" + std::to_string(error.mark.line + 1) + ": not YAML: " + error.msg);
  }
}

bool is_yaml(const fs::path& path) {
  return path.extension() == ".yaml" || path.extension() == ".yml";
}

/// Where the suites that ship lie: where the program is installed, else in the source tree.
fs::path suites_folder() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path installed = (program.parent_path() / LRRT_SUITES_FROM_PROGRAM).lexically_normal();
  return fs::is_directory(installed, ignored) ? installed : fs::path(LRRT_BENCH_SUITES);
}

}  // namespace

fs::path suite_file(const std::string& name) {
  fs::path path = is_yaml(name) ? fs::path(name) : suites_folder() / (name + ".yaml");
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored)) return path;
  std::string known;
  for (const std::string& suite : shipped_suites()) known += (known.empty() ? "" : ", ") + suite;
  throw SuiteError("suite '" + name + "' does not exist: expected one of " + known + ", or a file that ends in .yaml");
}

Suite parse_suite(const std::string& text, const std::string& file, const fs::path& folder) {
  const Fields fields(parsed(text, file), file, "");
  fields.require("kind", "plan or predict");
  Suite suite;
  suite.title = fields.text("title", "");
  suite.folder = folder;
  if (fields.word("kind", "plan", {"plan", "predict"}) == "plan") {
    suite.body = read_plan_suite(fields);
  } else {
    suite.body = read_predict_suite(fields);
  }
  return suite;
}

Suite load_suite(const std::string& name) {
  const fs::path path = suite_file(name);
  std::error_code ignored;
  if (fs::file_size(path, ignored) > longest_suite) {
    throw SuiteError(path.string() + ": too large; expected a suite of at most " + std::to_string(longest_suite) +
                     " bytes; is it the right file?");
  }
  std::ifstream stream(path, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  if (!stream) throw SuiteError(path.string() + ": cannot be read");
  return parse_suite(text.str(), path.string(), fs::proximate(fs::absolute(path).parent_path()));
}

std::vector<std::string> shipped_suites() {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(suites_folder(), ignored)) {
    if (is_yaml(entry.path())) names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

namespace {

/// How given maps are treated where a suite has none: five random queries each.
MapSource plain_treatment() {
  QuerySource query;
  query.kind = QuerySource::Kind::random;
  query.count = 5;
  MapSource source;
  source.kind = MapSource::Kind::folder;
  source.pixels = 0;
  source.queries = {query};
  return source;
}

bool same_treatment(const MapSource& a, const MapSource& b) {
  const auto settings = [](MapSource source) {
    source.name = source.path = "";
    if (source.kind == MapSource::Kind::file) source.kind = MapSource::Kind::folder;
    return to_json(source, true);
  };
  return settings(a) == settings(b);
}

/// The ways in which a suite treats the maps that it is given, each once. Queries at given places are for its own maps
/// only, and so is the scale.
std::vector<MapSource> treatments_of(const PlanSuite& suite) {
  std::vector<MapSource> result;
  for (MapSource source : suite.maps) {
    if (source.kind == MapSource::Kind::maze) continue;
    const auto elsewhere = [](const QuerySource& query) {
      return query.kind == QuerySource::Kind::points || query.kind == QuerySource::Kind::scen;
    };
    source.queries.erase(std::remove_if(source.queries.begin(), source.queries.end(), elsewhere), source.queries.end());
    if (source.queries.empty()) source.queries = plain_treatment().queries;
    source.scale = 1.0;
    const auto same = [&](const MapSource& other) { return same_treatment(source, other); };
    if (std::none_of(result.begin(), result.end(), same)) result.push_back(std::move(source));
  }
  if (result.empty()) result.push_back(plain_treatment());
  return result;
}

/// A user's own map or folder of maps.
MapSource own_maps(const std::string& path, MapSource treatment, bool only_treatment) {
  std::error_code ignored;
  const fs::path absolute = fs::absolute(path, ignored);
  if (path.empty() || !fs::exists(absolute, ignored))
    throw SuiteError("--maps '" + path + "': expected a map file or a folder of maps");
  const bool folder = fs::is_directory(absolute, ignored);
  if (treatment.kind != MapSource::Kind::mosaic)
    treatment.kind = folder ? MapSource::Kind::folder : MapSource::Kind::file;
  treatment.name = only_treatment ? path : path + ", " + treatment.name;
  treatment.path = absolute.string();
  return treatment;
}

void take_own_maps(const std::vector<std::string>& paths, PlanSuite& suite) {
  const std::vector<MapSource> treatments = treatments_of(suite);
  suite.maps.clear();
  for (const std::string& path : paths) {
    for (const MapSource& treatment : treatments) {
      MapSource source = own_maps(path, treatment, treatments.size() == 1);
      const auto same = [&](const MapSource& other) { return other.name == source.name; };
      if (std::any_of(suite.maps.begin(), suite.maps.end(), same))
        throw SuiteError("--maps '" + path + "': named twice");
      suite.maps.push_back(std::move(source));
    }
  }
}

/// The model that a user names, seen from the suite's folder, as the suite would name it.
std::string own_model(const std::string& model, const fs::path& folder) {
  if (model.empty()) throw SuiteError("--models '': expected a model file or a pattern");
  if (model == "default") return model;
  return fs::absolute(model).lexically_normal().lexically_proximate(fs::absolute(folder).lexically_normal()).string();
}

}  // namespace

void check_pixels(const Fields& fields, const std::string& key, int count, int side) {
  constexpr std::int64_t most = std::int64_t{1} << 32;
  if (std::int64_t{side} * side <= most / count) return;
  fields.refuse(key, "mazes of at most " + std::to_string(most) + " pixels in all, which are held in memory");
}

void apply(const Overrides& overrides, Suite& suite) {
  const double limit = overrides.time_limit.value_or(1.0);
  if (!(limit >= time_limits.least && limit <= time_limits.most)) {
    throw SuiteError("--time-limit " + std::to_string(limit) + ": expected " + time_limits.expected);
  }
  std::visit(
      [&](auto& body) {
        body.runs = overrides.runs.value_or(body.runs);
        body.seed = overrides.seed.value_or(body.seed);
      },
      suite.body);
  auto* plan = std::get_if<PlanSuite>(&suite.body);
  if (plan == nullptr && !overrides.maps.empty())
    throw SuiteError("--maps: the suite plans nothing; expected 'kind: plan'");
  auto* predict = std::get_if<PredictSuite>(&suite.body);
  if (predict == nullptr && !overrides.models.empty())
    throw SuiteError("--models: the suite plans; expected 'kind: predict', or 'model' in the suite's planners");
  if (predict != nullptr && !overrides.models.empty()) {
    predict->models.clear();
    for (const std::string& model : overrides.models) predict->models.push_back(own_model(model, suite.folder));
  }
  if (plan != nullptr) {
    if (!overrides.maps.empty()) take_own_maps(overrides.maps, *plan);
    for (PlanRow& row : plan->rows) row.options.time_limit = overrides.time_limit.value_or(row.options.time_limit);
  }
}

}  // namespace lrrt::bench
