# SPDX-License-Identifier: BSD-3-Clause
# The everyday commands. Each does the set-up that it needs, skips what is up to date, and can be interrupted and
# run again. Variables: PRESET (release, debug, asan, ci), JOBS, PYTHON, ONNXRUNTIME_ROOT, CONFIG, MODEL, SUITE,
# BENCH_OPTIONS, SECONDS, FUZZ, RUNS, LOAD_OPTIONS, LEAST_COVERAGE, LOCKED (no: Python tools as requirements-dev.txt
# allows, not as locked).
.DEFAULT_GOAL := help
.NOTPARALLEL:
SHELL := /bin/bash

PRESET ?= release
CONFIG ?= training/configs/fast.yaml
MODEL ?= models/default.onnx
SUITE ?= smoke
SECONDS ?= 60
FUZZ ?=
BENCH_OPTIONS ?=
RUNS ?= 100000
LOAD_OPTIONS ?=
JOBS ?= $(shell nproc)
export JOBS
python := .venv/bin/python

.PHONY: help
help: ## Show this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "make %-16s %s\n", $$1, $$2}' Makefile

.PHONY: setup
setup: ## Install what the build needs: apt packages, .venv, ONNX Runtime in .deps
	@scripts/setup_apt.sh
	@scripts/setup_python.sh
	@scripts/setup_onnxruntime.sh

.PHONY: build
build: setup ## Build the C++ library, programs, tests and the Python module into build/PRESET
	@scripts/build.sh $(PRESET)

.PHONY: install-python
install-python: build ## Install the Python package lrrt into .venv
	@scripts/install_python.sh $(PRESET)

.PHONY: demo
demo: install-python ## Plan on a sample map with the shipped model; writes demo.png
	@echo "==> Running the demo"
	@$(python) -m lrrt.demo

.PHONY: setup-training
setup-training: install-python
	@scripts/setup_training.sh

.PHONY: test
test: setup-training ## Run every test: C++, Python, training
	@echo "==> C++ tests"
	@ctest --test-dir build/$(PRESET) --output-on-failure --no-tests=error --parallel $(JOBS)
	@echo "==> Python tests"
	@$(python) -m pytest -q tests/python
	@echo "==> Training tests"
	@$(python) -m pytest -q -c training/pyproject.toml training/tests

.PHONY: train
train: setup-training ## Train a model: CONFIG=training/configs/fast.yaml
	@cd training && $(abspath $(python)) -m lrrt_training train --config $(abspath $(CONFIG))

.PHONY: evaluate
evaluate: setup-training ## Measure a model on the test mazes: MODEL=models/default.onnx
	@cd training && $(abspath $(python)) -m lrrt_training evaluate $(abspath $(MODEL))

.PHONY: bench
bench: build ## Measure: SUITE=smoke, predict, paper or a .yaml file; BENCH_OPTIONS="--json paper.json"
	@build/$(PRESET)/bench/lrrt_bench --suite $(SUITE) $(BENCH_OPTIONS)

.PHONY: micro
micro: build ## Time single calls of the library: BENCH_OPTIONS="--benchmark_filter=^region"
	@build/$(PRESET)/bench/micro/lrrt_micro $(BENCH_OPTIONS)

.PHONY: lint
lint: install-python ## Check formatting, style and types
	@scripts/lint.sh check

.PHONY: tidy
tidy: build ## Run clang-tidy on the library (minutes)
	@scripts/setup_apt.sh clang-tidy
	@scripts/lint.sh tidy $(PRESET)

.PHONY: fuzz
fuzz: setup ## Fuzz every reader and the planner with Clang's libFuzzer: SECONDS=60 for each, FUZZ="suite plan" for some
	@scripts/fuzz.sh $(SECONDS) $(FUZZ)

.PHONY: nightly
nightly: install-python ## Check many random queries by independent code: RUNS=100000 (ten minutes or so)
	@LRRT_PROPERTY_RUNS=$(RUNS) LRRT_PROPERTY_JOBS=$(JOBS) build/$(PRESET)/tests/lrrt_property_tests
	@LRRT_PROPERTY_RUNS=$$(( $(RUNS) / 50 + 1 )) $(python) -m pytest -q --timeout 3600 tests/python/test_properties.py

.PHONY: load
load: build ## Plan with 32 threads on one model for five minutes: LOAD_OPTIONS="--threads 8 --seconds 60"
	@build/$(PRESET)/tests/lrrt_load $(LOAD_OPTIONS)

.PHONY: sanitize
sanitize: setup ## Run the C++ tests under the address, undefined-behaviour and thread sanitizers
	@scripts/checks.sh sanitize

.PHONY: valgrind
valgrind: setup ## Run the C++ examples under valgrind's memcheck
	@scripts/setup_apt.sh valgrind
	@scripts/checks.sh valgrind

.PHONY: coverage
coverage: setup ## Measure how many lines of src/ the C++ tests run; fails below LEAST_COVERAGE=90 percent
	@scripts/setup_apt.sh gcovr
	@scripts/checks.sh coverage

.PHONY: format
format: setup ## Format C++ and Python sources in place
	@scripts/lint.sh fix

.PHONY: docs
docs: install-python ## Build the documentation's site: build/docs/html/index.html
	@scripts/setup_apt.sh doxygen
	@scripts/docs.sh

.PHONY: package
package: setup ## Make lrrt and lrrt-dev as .deb files, and an archive with both, in dist/
	@scripts/setup_apt.sh file
	@scripts/make_packages.sh

.PHONY: wheel
wheel: setup ## Make a wheel that needs nothing of the system, and the source archive, in dist/
	@scripts/make_wheel.sh

.PHONY: package-check
package-check: setup ## Make every package and use each away from this tree (minutes): PARTS="debs wheel sdist"
	@scripts/setup_apt.sh file
	@scripts/check_packages.sh $(PARTS)

.PHONY: lock
lock: setup ## Write the lock files of the Python requirements anew: LOCK_UPGRADE=yes takes the newest versions
	@scripts/lock.sh

.PHONY: clean
clean: ## Remove what was built; .venv and .deps stay
	rm -rf build dist
	rm -f .deps/stamps/configure-* .deps/stamps/lrrt
