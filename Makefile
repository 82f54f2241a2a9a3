# asbdpt: `make help` lists the targets. Needs a C99 compiler, make, libm and POSIX threads.
CC      ?= cc
OPT     ?= -O2
WARN     = -std=c99 -pedantic -Wall -Wextra -Wshadow -Wconversion -Wstrict-prototypes -Wmissing-prototypes -Wvla -Wswitch
# No fast-math; contraction off, so that one compiler gives one result.
FLAGS    = $(WARN) $(OPT) -ffp-contract=off -pthread
LIBS     = -lm -lpthread
SRC      = $(wildcard src/*.c)
OBJ      = $(SRC:src/%.c=$(BUILD)/%.o)
LIB_OBJ  = $(filter-out $(BUILD)/main.o,$(OBJ))
TEST_OBJ = $(patsubst test/%.c,$(BUILD)/test_%.o,$(wildcard test/*.c))
BUILD   ?= build

all: asbdpt ## build ./asbdpt

asbdpt: $(OBJ)
	$(CC) $(FLAGS) $(CFLAGS) -o $@ $(OBJ) $(LDFLAGS) $(LIBS)

$(BUILD)/test: $(LIB_OBJ) $(TEST_OBJ)
	$(CC) $(FLAGS) $(CFLAGS) -o $@ $(LIB_OBJ) $(TEST_OBJ) $(LDFLAGS) $(LIBS)

$(BUILD)/%.o: src/%.c | $(BUILD)
	$(CC) $(FLAGS) -MMD -MP $(CFLAGS) -c -o $@ $<

$(BUILD)/test_%.o: test/%.c | $(BUILD)
	$(CC) $(FLAGS) -MMD -MP $(CFLAGS) -c -o $@ $<

$(BUILD):
	mkdir -p $(BUILD)

help: ## list the targets
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' Makefile | expand -t 12

clean: ## remove everything that was built
	rm -rf build build-* asbdpt

-include $(wildcard $(BUILD)/*.d)

.PHONY: all help clean
