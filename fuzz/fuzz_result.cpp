// SPDX-License-Identifier: BSD-3-Clause
/// Input: a result file of lrrt_bench, as --replay reads it, and once more the rows of a run that was interrupted.
#include "replay.hpp"
#include "result_file.hpp"
#include "support.hpp"

namespace {

using namespace lrrt;
using namespace lrrt::bench;

void replay(const std::filesystem::path& file) {
  const Json document = read_result(file);
  replayed_suite(document, file);
  replay_limits(document);
  std::vector<Job> jobs;
  for (const Json& row : document.at("rows")) jobs.push_back({row.at("id").get<std::string>(), "", nullptr});
  keep_jobs_of(document, jobs);
  check_inputs(document, document.value("inputs", Json::object()), file);
  fuzz::require(compare_replay(document, document).same, "a result is the same as itself");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  const std::string text = fuzz::text_of(data, size);
  fuzz::answer_or_typed_error([&] { replay(folder.write("result.json", text)); });
  fuzz::answer_or_typed_error([&] {
    folder.write("run.json.part", "{\"suite\":1}\n" + text);
    ResultFile results(folder.path() / "run.json", {{"suite", 1}});
    results.add({{"id", "fuzz"}});
    fuzz::require(results.has("fuzz"), "a row that was added is there");
  });
  return 0;
}
