# asbdpt: `make help` lists the targets. Needs a C99 compiler, GNU make (3.81 will do), libm and POSIX threads.
# The next line is a message to BSD make, and to GNU make a rule that nothing uses.
.error : asbdpt needs GNU make (gmake), or the line in doc/portability.md that builds without any make
CC      = cc
export CC
BUILD   = build
PROGRAM = ./asbdpt
LAB     = ./asbdpt-lab
SCENES  = $(addprefix scenes/,$(addsuffix .pbrt,cornell-box cornell-box-modified veach-ajar bathroom living-room))

PREFIX  = /usr/local
MANDIR  = $(PREFIX)/share/man/man1
LIBDIR  = $(PREFIX)/lib

# No fast-math; contraction off, so that one compiler gives one result. Nobody reads errno after sqrt.
# Link-time optimisation saves 6 % of the instructions; `make LTO=` leaves it out. CFLAGS is the user's and comes last.
WARN    = -std=c99 -pedantic -Wall -Wextra -Wshadow -Wconversion -Wstrict-prototypes -Wmissing-prototypes -Wvla -Wswitch
OPT     = -O3 $(LTO)
FLAGS   = $(WARN) $(OPT) -Isrc -ffp-contract=off -fno-math-errno -fPIC -pthread
LIBS    = -lm -lpthread
# These are asked of the compiler at the first use, once.
LTO     = $(eval LTO := $$(shell sh test/run/compiler.sh lto $$(CC)))$(LTO)
DEPEND  = $(eval DEPEND := $$(shell sh test/run/compiler.sh depend $$(CC)))$(DEPEND)

OBJECTS  = $(patsubst src/%.c,$(BUILD)/obj/%.o,$(wildcard src/*/*.c))
LABS     = $(patsubst test/%.c,$(BUILD)/obj/test/%.o,$(wildcard test/lab/*.c test/lab/*/*.c)) \
           $(filter-out %/cli/program.o %/render/rows.o,$(OBJECTS))
TARGETS  = $(patsubst %,$(BUILD)/obj/test/fuzz/%.o,targets hostile lists)
TESTS    = $(patsubst test/%.c,$(BUILD)/obj/test/%.o,$(wildcard test/unit/*.c)) $(TARGETS)
BOXED    = $(patsubst src/%.c,%.o,$(wildcard src/scene/scene.c src/scene/medium.c src/render/job.c))
PROGRAMS = asbdpt asbdpt-lab $(addprefix $(BUILD)/,test boxes fuzz inject inject-lab inject-library embree)

# The tests, too, if they were built before: what is run is never older than its sources.
all: asbdpt asbdpt-lab $(wildcard $(BUILD)/test) ## build ./asbdpt, the renderer, and ./asbdpt-lab, the laboratory (the default)
	@echo "Built. Next: make demo, ./asbdpt --help, make test, make help."

# ---- what is built ----
# A line for each file; V=1 shows the commands.
SAY = $(if $(V),,@echo "  $@";)

asbdpt: $(OBJECTS)
asbdpt-lab: $(LABS)
$(BUILD)/test: $(TESTS) $(filter-out %/main.o,$(LABS))
$(BUILD)/fuzz: $(BUILD)/obj/test/fuzz/libfuzzer.o $(TARGETS) $(filter-out %/main.o,$(LABS))
# the renderer with a tree of boxes in place of the kd-tree
$(BUILD)/boxes: $(filter-out $(addprefix $(BUILD)/obj/,$(BOXED)),$(OBJECTS)) $(addprefix $(BUILD)/obj/boxed/,$(BOXED)) \
    $(patsubst test/%.c,$(BUILD)/obj/test/%.o,$(wildcard test/boxes/*.c))
# both programs, except for functions that may fail: test/fuzz/inject.c has others in their place
$(BUILD)/inject: $(OBJECTS) $(BUILD)/obj/test/fuzz/inject.o
$(BUILD)/embree: $(BUILD)/obj/test/measure/peers/embree.o $(filter-out %/main.o,$(LABS))
$(BUILD)/embree: LIBS += -lembree3
$(BUILD)/inject-lab: $(LABS) $(BUILD)/obj/test/fuzz/inject.o
$(BUILD)/inject-library: $(BUILD)/obj/test/fuzz/embed.o $(filter-out %/main.o,$(OBJECTS)) $(BUILD)/obj/test/fuzz/inject.o

$(PROGRAMS): $(BUILD)/files
	$(SAY)$(CC) $(FLAGS) $(AT_LINK) $(CFLAGS) -o $@ $(filter %.o,$^) $(LDFLAGS) $(LIBS)

$(BUILD)/obj/test/%.o: test/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(SAY)$(CC) $(FLAGS) $(TESTED) -Itest -Itest/lab -Itest/unit -I$(BUILD) $(DEPEND) $(CFLAGS) -c -o $@ $<

$(BUILD)/obj/boxed/%.o: src/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(SAY)$(CC) $(FLAGS) $(foreach name,build closest all occluded,-Dkd_$(name)=box_$(name)) $(DEPEND) $(CFLAGS) -c -o $@ $<

$(BUILD)/obj/%.o: src/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(SAY)$(CC) $(FLAGS) $(DEPEND) $(CFLAGS) -c -o $@ $<

# All but the renderer is built quickly: without optimisation of the whole, and what only tests with little of its own.
NO_LTO = $(if $(LTO),-fno-lto)
$(TESTS): TESTED = $(NO_LTO) -O1
$(TESTS): | $(BUILD)/suites.h
asbdpt-lab $(BUILD)/test $(BUILD)/boxes: AT_LINK = $(NO_LTO)
$(BUILD)/fuzz: AT_LINK = -fsanitize=fuzzer

# ---- the library ----
# Of the renderer's own objects, which are movable for it; the archive is without what optimises the whole. Who links
# sees the functions of asbdpt.h, and with the archive the others, too, whose names are the program's own.
INSIDE = $(filter-out $(BUILD)/obj/cli/%,$(OBJECTS))
$(BUILD)/libasbdpt.a: $(INSIDE)
	@rm -f $@
	$(SAY)$(AR) rcs $@ $(INSIDE) $(if $(LTO),&& objcopy -R '.gnu.lto_*' -R '.llvm.lto*' $@)
$(BUILD)/libasbdpt.so: $(INSIDE)
	$(SAY)$(CC) $(FLAGS) $(NO_LTO) -shared $(CFLAGS) -o $@ $(INSIDE) $(LDFLAGS) $(LIBS)

lib: $(BUILD)/libasbdpt.a $(BUILD)/libasbdpt.so ## build the library, build/libasbdpt.a and .so; its header is src/library/asbdpt.h
amalgamation: ## the program and the library as one file of C and one header: out/asbdpt.c, out/asbdpt.h
	sh doc/embed/amalgamate.sh out

# These change when the compiler, its flags or the list of files do. Then all is compiled, or linked, again; as it is if
# a header changes and the compiler does not write which files include it.
HEADERS = $(shell cat $(wildcard src/*/*.h test/*/*.h test/*/*/*.h) | cksum)
$(BUILD)/flags: export NOW = $(shell $(CC) --version 2>&1) $(CC) $(FLAGS) $(CFLAGS) $(LDFLAGS) $(if $(DEPEND),,$(HEADERS))
$(BUILD)/files: export NOW = $(OBJECTS) $(LABS) $(TESTS)
$(BUILD)/flags $(BUILD)/files: FORCE
	@mkdir -p $(@D)
	@echo "$$NOW" | cmp -s - $@ || echo "$$NOW" >$@
$(BUILD)/suites.h: test/unit/suites.awk $(wildcard test/unit/*.c)
	@mkdir -p $(@D)
	@awk -f $^ >$@.new && { cmp -s $@.new $@ || cp $@.new $@; }

-include $(wildcard $(BUILD)/obj/*/*.d $(BUILD)/obj/*/*/*.d $(BUILD)/obj/*/*/*/*.d)

# ---- what it is for ----
# All cores, unless make has been told how many jobs.
CORES = $(if $(filter -j% --jobserver%,$(MAKEFLAGS)),,-j$$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2))
# Paths come to the shell as variables, for they may hold blanks and quotes. Whatever the umask, everybody may read.
install uninstall: export TO_BIN = $(DESTDIR)$(PREFIX)/bin
install uninstall: export TO_MAN = $(DESTDIR)$(MANDIR)
install uninstall: export TO_LIB = $(DESTDIR)$(LIBDIR)
install uninstall: export TO_INCLUDE = $(DESTDIR)$(PREFIX)/include
install: export AT = $(PREFIX)
install: export AT_LIB = $(LIBDIR)

install: all lib ## install programs, man pages, library and header below PREFIX (/usr/local), itself below DESTDIR
	umask 022 && mkdir -p "$$TO_BIN" "$$TO_MAN" && for name in asbdpt asbdpt-lab; do \
	    install -m 755 $$name "$$TO_BIN/$$name" && \
	    { printf '.TH %s 1\n.SH NAME\n%s \\- bidirectional path tracing\n.SH DESCRIPTION\n.nf\n' $$name $$name && \
	    ./$$name help all | sed 's/\\/\\e/g; s/-/\\-/g; s/^/\\\&/'; } >"$$TO_MAN/$$name.1" && \
	    chmod 644 "$$TO_MAN/$$name.1" || exit; done
	umask 022 && mkdir -p "$$TO_LIB/pkgconfig" "$$TO_INCLUDE" && install -m 644 src/library/asbdpt.h "$$TO_INCLUDE" && \
	    install -m 644 $(BUILD)/libasbdpt.a "$$TO_LIB" && install -m 755 $(BUILD)/libasbdpt.so "$$TO_LIB" && \
	    version=$$(sed -n 's/^#define VERSION "asbdpt \(.*\)"$$/\1/p' src/base/version.h) && \
	    printf '%s\n' "Name: asbdpt" "Description: bidirectional path tracing" "Version: $$version" \
	    "Cflags: -I\"$$AT/include\"" "Libs: -L\"$$AT_LIB\" -lasbdpt" "Libs.private: -lm -lpthread" \
	    >"$$TO_LIB/pkgconfig/asbdpt.pc"

uninstall: ## remove what install put there
	rm -f "$$TO_BIN/asbdpt" "$$TO_MAN/asbdpt.1" "$$TO_BIN/asbdpt-lab" "$$TO_MAN/asbdpt-lab.1"
	rm -f "$$TO_INCLUDE/asbdpt.h" "$$TO_LIB/libasbdpt.a" "$$TO_LIB/libasbdpt.so" "$$TO_LIB/pkgconfig/asbdpt.pc"

demo: ## build both programs with all cores, and render the corridor by bdpt and asbdpt in the same time: out/demo.png (50 s of CPU)
	@$(MAKE) $(CORES) asbdpt asbdpt-lab
	@rm -rf out/demo
	$(LAB) equal-time scenes/corridor.pbrt --reference ref/demo/corridor.png --spp 48 --seeds 1 -o out/demo >/dev/null
	@cp out/demo/images/corridor.png out/demo.png
	@awk -F '[, ]' '$$1 == "noise8" { noise = $$2 }; \
	    FNR < NR && FNR > 1 { printf "%s: %d samples in %.1f s of CPU, rmse8 %.1f\n", $$2, $$4, $$5, $$6 }; \
	    END { printf "rmse8: root mean square error of 8-bit values; the noise of the reference, %.1f, is part of it\n", noise }' \
	    ref/demo/corridor.txt out/demo/runs.csv
	@echo "wrote out/demo.png; curves: out/demo/report.html"

gallery: asbdpt ## render the images of doc/gallery.md by the commands there, into out/gallery (20 minutes of CPU)
	@mkdir -p out/gallery
	@sed -n 's/^    //p' doc/gallery.md | sh -ex

experiments: asbdpt-lab ## chapter 4 of the dissertation, measured again, into out/experiments/report.html (twelve minutes on two cores; PUBLISHED=DIR: on its scenes)
	sh test/measure/experiments.sh out/experiments

web: asbdpt ## build and test the page that renders, out/asbdpt.html, where clang can compile for wasm32-wasi
	sh doc/web/build.sh out/asbdpt.html
	sh test/run/web.sh out/asbdpt.html

bench: ## measure speed and memory on the scenes (or SCENES="..."), the laboratory linked as the renderer is
	rm -f asbdpt-lab && $(MAKE) NO_LTO= asbdpt-lab
	$(LAB) bench $(SCENES) scenes/test/many-lamps.pbrt

ref: asbdpt asbdpt-lab ## render the stored references of ref/ again (an hour; goes on where it stopped)
	sh ref/make-ref.sh $(PROGRAM)

# ---- what proves it ----
# Checks are targets of their own; none of them builds anything while others run.
FACTS = $(foreach name,layers standard references limits specimens links measured faults,"$(MAKE) -s -o asbdpt-lab $(name)")
check: asbdpt-lab ## facts about sources and documents, in ten seconds
	@sh test/run/suites.sh $(FACTS)

LONG  = $(foreach name,mini cli checkpoint build examples progress embed,"sh test/run/$(name).sh $(PROGRAM)")
SHORT = $(foreach name,lab sample corpus outputs boxes install suites_test hashes_test hashes,"sh test/run/$(name).sh $(PROGRAM)") \
    "LIST=test/lab/hashes.txt sh test/run/hashes.sh $(LAB)" "sh test/tree/words_test.sh" \
    "sh test/run/readme.sh $(PROGRAM) doc/scene-format.md doc/tour/trace.md"
test: ## build with all cores, and run the test suite (four minutes on two cores)
	@$(MAKE) $(CORES) asbdpt asbdpt-lab $(BUILD)/test $(BUILD)/boxes lib
	@sh test/run/suites.sh $(LONG) $(FACTS) $(BUILD)/test $(SHORT)

scripts: asbdpt asbdpt-lab $(BUILD)/boxes lib ## what depends on the sh and awk of a system: no suites in C, few samples
	@BRIEF=yes sh test/run/suites.sh $(LONG) $(FACTS) $(SHORT)

check-long: export FULL = yes
check-long: asbdpt asbdpt-lab $(BUILD)/test experiments web portability inject ## the tests that take longer
	@sh test/run/suites.sh "sh test/run/course.sh prove" "$(BUILD)/test --slow" "sh test/run/checkpoint.sh $(PROGRAM) 100" \
	    "sh test/run/readme.sh $(PROGRAM)" "PICTURES=all sh test/run/mini.sh $(PROGRAM)" "BUILD=$(BUILD) sh test/run/add_method.sh" \
	    "sh test/run/report.sh $(PROGRAM)" "sh test/run/examples.sh $(PROGRAM)" "sh test/run/embed.sh $(PROGRAM)" \
	    "sh doc/tour/figures.sh $(PROGRAM) out/figures && \
	    diff -r -x equal.png doc/tour/figures out/figures"
	if command -v python3 >/dev/null; then python3 test/measure/recompute.py; else echo "recompute: skipped: no python3"; fi
	sh test/run/cluster.sh $(PROGRAM)
	BUILD=$(BUILD) COUNT=12 sh test/measure/structures.sh out/structures
	BUILD=$(BUILD) COUNT=10 SPP=16 sh test/measure/predictions.sh out/race
	RES=8x6 SPP=1 REFERENCE_SPP=1 SEEDS=61 sh test/lab/tune.sh out/tune pt

check-ref: asbdpt asbdpt-lab ## check that the program still converges to the stored references
	sh ref/check-ref.sh $(PROGRAM)

portability: ## build by every compiler, and for every system, that is at hand or emulated; the images must be the same
	sh test/run/portability.sh
	sh test/run/tools.sh

hashes: asbdpt asbdpt-lab ## write the checksums of images again, after a change that is meant to change images
	sh test/run/hashes.sh $(PROGRAM) renew
	LIST=test/lab/hashes.txt sh test/run/hashes.sh $(LAB) renew

mutants: ## apply small faults one by one; the tests must catch every one
	sh test/data/mutants/run.sh 2

layers: ## check that no file includes a higher folder, that no includes go in a circle, that headers compile alone and offer what is used
	@ABOVE="test/lab/caustics test/lab/rivals test/lab/chains test/lab" sh test/tree/layers.sh src $(CC)

standard: ## check that src calls and includes nothing that differs from machine to machine, except in base/os*.c; nor scripts
	@sh test/tree/standard.sh

references: ## check that every source named in a comment is in doc/references.md, and that all there are used
	@sh test/tree/references.sh

faults: ## check that every fault of the list of mutants still applies, and every hole of the course
	@sh test/data/mutants/apply.sh check test/data/mutants/list.txt test/lab/tune.txt test/course/plants.txt
	@sh test/measure/power.sh check
	@sh test/run/course.sh check

evidence: ## measure again what is old or missing of the documents' numbers (NAMES="..."; hours), and fill it in
	sh test/measure/evidence.sh run $(NAMES)

measured: ## check that the documents show the stored numbers, and mark old ones
	@sh test/measure/evidence.sh check

.PHONY: limits
limits: ## check that SECURITY.md says what the limits of the program are
	@sh test/tree/limits.sh

specimens: ## check that every kind of thing that scenes have is in a unit suite, in the generator of scenes and in scenes/features
	@sh test/tree/specimens.sh

links: asbdpt-lab ## check that links, functions, tests and mutants named in the documents exist, what these take from sources, and their HTML
	@sh test/tree/pages.sh
	@sh test/tree/html.sh

san: ## run the tests (or SUITES="...") under the address and undefined-behaviour sanitizers
	$(MAKE) BUILD=build-san OPT="-O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all" build-san/test
	sh test/run/suites.sh $(if $(SUITES),$(foreach suite,$(SUITES),"build-san/test $(suite)"),build-san/test)

INJECTED = calloc realloc fwrite fprintf fputs fputc fclose fsync fdopen rename pthread_create
.PHONY: inject
inject: all lib ## make every allocation, write, close, rename and thread fail once, and see what the program does
	$(MAKE) BUILD=build-inject LTO= OPT="-O1 $(foreach name,$(INJECTED),-D$(name)=inject_$(name))" build-inject/inject build-inject/inject-lab
	sh test/run/inject.sh build-inject/inject
	$(MAKE) BUILD=build-inject-asan LTO= OPT="-O1 -g -fsanitize=address $(foreach name,$(INJECTED),-D$(name)=inject_$(name))" build-inject-asan/inject-library
	sh test/run/embed.sh $(PROGRAM) build-inject-asan/inject-library

.PHONY: fuzz
fuzz: ## build build-fuzz/fuzz, which feeds every reader with damaged input (clang; sh test/fuzz/run.sh runs it)
	$(MAKE) BUILD=build-fuzz CC=clang LTO= OPT="-O1 -g -fno-omit-frame-pointer -fsanitize=fuzzer-no-link,address,undefined,float-cast-overflow -fno-sanitize-recover=all" build-fuzz/fuzz

tsan: ## run the threaded tests under the thread sanitizer
	$(MAKE) BUILD=build-tsan OPT="-O1 -g -fsanitize=thread" build-tsan/test
	build-tsan/test threads

# ---- about the tree ----
release: all ## what a release consists of, into out/release: sources, the page that renders, man pages, checksums
	sh test/tree/release.sh out/release

doc: ## all documents, and the sources to read, as static HTML in out/html; begin with index.html
	sh doc/html.sh out/html

figures: asbdpt asbdpt-lab ## make the figures of doc/tour again
	sh doc/tour/figures.sh $(PROGRAM)

stats: ## files, lines, code and comment of every part, and words of documents, beside their goals
	@sh test/tree/tree_stats.sh

tidy: stats ## the same, and what is long: lines, sentences and pages; and phrases that readers stumble over
	@sh test/tree/columns.sh || true
	@sh test/tree/words.sh || true

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]*:.*## / { printf "%-11s %s\n", $$1, $$2 }' Makefile

clean: ## remove everything that was built
	rm -rf build build-* out asbdpt asbdpt-lab

.PHONY: FORCE all lib amalgamation check install uninstall demo gallery experiments web release bench ref test check-long check-ref portability hashes faults mutants scripts \
	layers standard references links evidence measured doc figures san tsan stats tidy help clean
