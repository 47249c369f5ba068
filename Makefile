# `make play` and `make test` do all their set-up themselves, on Debian and Ubuntu with Rust.
# On other systems they name what is missing.

# What a window, pictures without a window, and their tests need from the system.
PACKAGES := xvfb xdotool imagemagick libegl1 libegl-mesa0 libgl1-mesa-dri libxcursor1 libxi6 \
	libxrandr2 libxkbcommon-x11-0 pkg-config libasound2-dev libudev-dev
CARGO := cargo
# How long `make fuzz` looks at each of its TARGETS; at all of them if none is named.
MINUTES ?= 10

.PHONY: play test report pictures window hour peers fuzz builds light licences deb setup early \
	featureless lints everything documents package

play: setup
	$(CARGO) run --release --locked --package hapticbillard-actors --bin hapticbillard -- play

# Measures everything of tests/report anew: about ten minutes of a quiet machine.
report:
	$(CARGO) run --release --locked --package hapticbillard-actors --no-default-features -- \
	  report --builds tests/report/builds.json --out tests/report

# Pictures of what the renderer can do, without a window, into target/pictures.
pictures: setup
	$(CARGO) build --release --locked --package hapticbillard-actors
	tests/pictures/run.sh target/release/hapticbillard target/pictures

# A whole game with real mouse and key events, in real time on a virtual display.
window: setup
	WINDOW_TESTS=1 $(CARGO) test --locked --package hapticbillard-actors --test runtime whole_game:: \
	  -- --nocapture

# An hour of games in a window, with sound to nobody and a simulated hand: nothing may grow.
hour: setup
	$(CARGO) build --release --locked --package hapticbillard-actors
	tests/soak/window.sh target/release/hapticbillard 60 target/hour

# Other programs on the report's cases, and the report with them: see tests/peers/README.md.
peers:
	python3 tests/peers/run.py

# What each feature adds to the program, for the report: see tests/builds/run.py.
builds:
	python3 tests/builds/run.py
	$(CARGO) run --release --locked --package hapticbillard-actors --no-default-features -- \
	  report --left-out --builds tests/report/builds.json --out tests/report

# The light of the rooms, baked anew into assets/light: some minutes.
light: setup
	$(CARGO) run --release --locked --package hapticbillard-actors --bin hapticbillard -- \
	  bake --out assets/light

# Lists the licences of all libraries anew.
licences:
	UPDATE_LICENCES=1 $(CARGO) test --quiet --locked --package hapticbillard-actors --test runtime \
	  licences::

# The Debian package, into target/debian; needs `cargo install --locked cargo-deb`.
DEB := target/release/deb
deb: setup
	$(CARGO) build --release --locked --package hapticbillard-actors
	rm -rf $(DEB)
	target/release/hapticbillard man --out $(DEB)/man
	for shell in bash zsh fish; do \
	  target/release/hapticbillard completions $$shell > $(DEB)/hapticbillard.$$shell || exit 1; \
	done
	python3 actors/debian/texts.py $(DEB)/third-party
	cp actors/CHANGELOG.md $(DEB)/changelog
	gzip -9n $(DEB)/changelog $(DEB)/third-party $(DEB)/man/*
	$(CARGO) deb --locked --package hapticbillard-actors --no-build --strip

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

# The default features are all but those for developers, which only the lints compile.
everything:
	$(CARGO) test --quiet --locked --workspace

documents:
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --quiet --locked --workspace --no-deps

package:
	$(CARGO) package --quiet --locked --workspace --no-verify --allow-dirty
