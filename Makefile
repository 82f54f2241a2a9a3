# asbdpt: `make help` lists the targets. Needs a C99 compiler, make, libm and POSIX threads.
CC       = cc
BUILD    = build
OPT      = -O3 $(LTO)
# Link-time optimisation, where compiler and linker can do it, makes small scenes 10 % faster. `make LTO=` leaves it out.
LTO      := $(shell d=$$(mktemp -d) && echo 'int main(void) { return 0; }' > $$d/a.c && \
              $(CC) -flto=auto -o $$d/a $$d/a.c >/dev/null 2>&1 && $$d/a && echo -flto=auto; rm -rf "$$d")
WARN     = -std=c99 -pedantic -Wall -Wextra -Wshadow -Wconversion -Wstrict-prototypes -Wmissing-prototypes -Wvla -Wswitch
# No fast-math; contraction off, so that one compiler gives one result. Nobody reads errno after sqrt. CFLAGS is the user's and comes last.
FLAGS    = $(WARN) $(OPT) -ffp-contract=off -fno-math-errno -pthread
LIBS     = -lm -lpthread
OBJ      = $(patsubst src/%.c,$(BUILD)/%.o,$(wildcard src/*.c))
TEST_OBJ = $(filter-out $(BUILD)/main.o,$(OBJ)) $(patsubst test/%.c,$(BUILD)/test_%.o,$(wildcard test/*.c))
PROGRAM  = ./asbdpt
SCENES   = $(addprefix scenes/,$(addsuffix .pbrt,cornell-box cornell-box-modified veach-ajar bathroom living-room))

all: asbdpt ## build ./asbdpt (the default)

asbdpt: $(OBJ)
	$(CC) $(FLAGS) $(CFLAGS) -o $@ $(OBJ) $(LDFLAGS) $(LIBS)

$(BUILD)/test: $(TEST_OBJ)
	$(CC) $(FLAGS) $(CFLAGS) -o $@ $(TEST_OBJ) $(LDFLAGS) $(LIBS)

$(BUILD)/%.o: src/%.c | $(BUILD)
	$(CC) $(FLAGS) -MMD -MP $(CFLAGS) -c -o $@ $<

$(BUILD)/test_%.o: test/%.c | $(BUILD)
	$(CC) $(FLAGS) -MMD -MP $(CFLAGS) -c -o $@ $<

$(BUILD) out:
	mkdir -p $@

demo: asbdpt | out ## render the Cornell box with bdpt and asbdpt into out/
	$(PROGRAM) render scenes/cornell-box.pbrt --res 256x256 --spp 64 --integrator bdpt -o out/demo-bdpt.png -o out/demo-bdpt.pfm
	$(PROGRAM) render scenes/cornell-box.pbrt --res 256x256 --spp 64 --integrator asbdpt -o out/demo-asbdpt.png -o out/demo-asbdpt.pfm
	@echo "look at out/demo-bdpt.png and out/demo-asbdpt.png, side by side"

test: asbdpt $(BUILD)/test layers ## build and run the test suite (under 3 minutes)
	sh test/cli.sh $(PROGRAM)
	$(BUILD)/test

check-long: asbdpt $(BUILD)/test experiments builds ## the tests that take longer
	$(BUILD)/test --slow

builds: asbdpt ## build by every compiler at hand, for 32 bits and with fused multiply-add; the pictures must be the same
	sh test/builds.sh $(PROGRAM)

bench: asbdpt | out ## measure speed and memory on the scenes (or SCENES="..."), beside doc/bench-baseline.json
	$(PROGRAM) bench $(SCENES) --json out/bench.json --baseline doc/bench-baseline.json

experiments: asbdpt | out ## measure all methods on the five scenes, quickly, into out/experiments/report.html
	$(PROGRAM) experiment --quick -o out/experiments
	sh test/report_browser.sh out/experiments/report.html

mutants: ## apply small faults one by one; the tests must catch every one
	sh test/mutants/run.sh 2

ref: asbdpt ## render the stored references of ref/ again (an hour; goes on where it stopped)
	sh ref/make-ref.sh $(PROGRAM)

check-ref: asbdpt ## are the stored references still what the program converges to?
	sh ref/check-ref.sh $(PROGRAM)

layers: ## check that every file includes only lower layers, and that headers compile alone
	@sh test/layers.sh $(CC)

san: ## run the tests under the address and undefined-behaviour sanitizers
	$(MAKE) BUILD=build-san OPT="-O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all" build-san/test
	build-san/test

tsan: ## run the threaded tests under the thread sanitizer
	$(MAKE) BUILD=build-tsan OPT="-O1 -g -fsanitize=thread" build-tsan/test
	build-tsan/test threads

help: ## list the targets
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' Makefile | expand -t 12

clean: ## remove everything that was built
	rm -rf build build-* out asbdpt

-include $(wildcard $(BUILD)/*.d)

.PHONY: all demo test bench check-long builds mutants ref check-ref experiments layers san tsan help clean
