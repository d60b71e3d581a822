// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/State.h>
#include <ompl/control/Control.h>

#include <mutex>
#include <vector>

namespace lrrt {

/// Items that are used again once they are given back, and of which none is lost if it never is.
template <typename Item>
class Pool {
 public:
  template <typename Make>
  Item* take(const Make& make) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (idle_.empty()) {
      all_.push_back(make());
      idle_.reserve(all_.capacity());  // giving back must not fail: destructors do it
      return all_.back();
    }
    Item* item = idle_.back();
    idle_.pop_back();
    return item;
  }
  void give_back(Item* item) {
    const std::lock_guard<std::mutex> lock(mutex_);
    idle_.push_back(item);
  }
  const std::vector<Item*>& all() const { return all_; }

 private:
  std::mutex mutex_;
  std::vector<Item*> all_;
  std::vector<Item*> idle_;
};

/// A state space that frees every state at its own end: SST, LazyPRM and SORRT* of OMPL 1.5 forget some of theirs. A
/// state that is used again starts with the values of its last use.
template <typename Space>
class KeptStates final : public Space {
 public:
  using Space::Space;
  KeptStates(const KeptStates&) = delete;
  KeptStates& operator=(const KeptStates&) = delete;
  ~KeptStates() override {
    for (ompl::base::State* state : pool_.all()) Space::freeState(state);
  }

  ompl::base::State* allocState() const override {
    return pool_.take([this] { return Space::allocState(); });
  }
  void freeState(ompl::base::State* state) const override { pool_.give_back(state); }

 private:
  mutable Pool<ompl::base::State> pool_;
};

/// The same for controls, of which SST forgets some.
template <typename Space>
class KeptControls final : public Space {
 public:
  using Space::Space;
  KeptControls(const KeptControls&) = delete;
  KeptControls& operator=(const KeptControls&) = delete;
  ~KeptControls() override {
    for (ompl::control::Control* control : pool_.all()) Space::freeControl(control);
  }

  ompl::control::Control* allocControl() const override {
    return pool_.take([this] { return Space::allocControl(); });
  }
  void freeControl(ompl::control::Control* control) const override { pool_.give_back(control); }

 private:
  mutable Pool<ompl::control::Control> pool_;
};

}  // namespace lrrt
