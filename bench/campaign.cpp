// SPDX-License-Identifier: BSD-3-Clause
#include "campaign.hpp"

#include "machine.hpp"

namespace lrrt::bench {

Json header_of(const Suite& suite, const Campaign& campaign) {
  return {{"suite", to_json(suite)},   {"folder", suite.folder.generic_string()},
          {"inputs", campaign.inputs}, {"versions", versions(campaign.onnxruntime, campaign.libtorch)},
          {"machine", machine()},      {"started", now()}};
}

}  // namespace lrrt::bench
