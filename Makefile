# `make play` and `make test` do all their set-up themselves, on Debian and Ubuntu with Rust.
# On other systems they name what is missing.

# What a window, pictures without a window, and their tests need from the system.
PACKAGES := xvfb xdotool imagemagick libegl1 libegl-mesa0 libgl1-mesa-dri libxcursor1 libxi6 \
	libxrandr2 libxkbcommon-x11-0 pkg-config libasound2-dev
CARGO := cargo
# How long `make fuzz` looks at each of its TARGETS; at all of them if none is named.
MINUTES ?= 10

.PHONY: play test report window peers fuzz setup early featureless lints everything documents package

play: setup
	$(CARGO) run --release --locked --package hapticbillard-actors --bin hapticbillard -- play

# Measures everything of tests/report anew: about ten minutes of a quiet machine.
report:
	$(CARGO) run --release --locked --package hapticbillard-actors --no-default-features -- \
	  report --out tests/report

# A whole game with real mouse and key events, in real time on a virtual display.
window: setup
	WINDOW_TESTS=1 $(CARGO) test --locked --package hapticbillard-actors --test runtime whole_game:: \
	  -- --nocapture

# Other programs on the report's cases, and the report with them: see tests/peers/README.md.
peers:
	python3 tests/peers/run.py

# Looks for bytes that break what reads them, so many minutes each target: see
# tests/fuzz/coverage/README.md.
fuzz:
	MINUTES=$(MINUTES) CARGO=$(CARGO) tests/fuzz/coverage/run.sh $(TARGETS)

# Fails early: what is cheap and what breaks most often comes first.
test: early setup featureless lints everything documents package

# Nothing is asked of the network or of sudo if everything is there already.
setup:
	@command -v $(CARGO) >/dev/null || { echo "Rust is missing: see https://rustup.rs"; exit 1; }
	@missing=""; \
	if command -v dpkg-query >/dev/null; then \
	  for package in $(PACKAGES); do \
	    dpkg-query -W -f='$${Status}' $$package 2>/dev/null | grep -q 'ok installed' \
	      || missing="$$missing $$package"; \
	  done; \
	fi; \
	if [ -z "$$missing" ]; then exit 0; fi; \
	if [ "$$(id -u)" = 0 ]; then sudo=""; \
	elif command -v sudo >/dev/null; then sudo="sudo"; \
	else echo "Please install as root: apt-get install$$missing"; exit 1; fi; \
	echo "installing$$missing"; \
	$$sudo apt-get update -qq && \
	$$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
	  $$missing

# Modules that a macro declares are not found by cargo fmt.
early:
	$(CARGO) fmt --all --check
	rustfmt --edition 2024 --check src/rules/games/*.rs tests/stub_hd/hd.rs
	$(CARGO) test --quiet --locked --package hapticbillard

featureless:
	$(CARGO) test --quiet --locked --workspace --no-default-features

lints:
	$(CARGO) clippy --quiet --locked --workspace --all-targets --no-default-features -- -D warnings
	$(CARGO) clippy --quiet --locked --workspace --all-targets --all-features -- -D warnings

everything:
	$(CARGO) test --quiet --locked --workspace --all-features

documents:
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --quiet --locked --workspace --no-deps

package:
	$(CARGO) package --quiet --locked --workspace --no-verify --allow-dirty
