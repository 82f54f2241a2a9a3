/* methods.h: what is measured: methods with settings of their own, named by a text.
 *
 *     bdpt                                      an integrator with its defaults
 *     asbdpt:select=bins:restart=16             with parameters, as -P gives them
 *     asbdpt:select=bins/pool:restart=0/8       with each of several values: four methods
 *     bdpt,lvc,asbdpt                           a list
 *
 * The text of one is its name in tables and files. No other file of the laboratory knows methods by name.
 *
 * Tests: test_plan.c.
 */
#ifndef ASBDPT_LAB_METHODS_H
#define ASBDPT_LAB_METHODS_H

#include "render/render.h"

enum { METHODS_MAX = 64, METHOD_TEXT = 192 };

struct measured {
    char text[METHOD_TEXT];
    char file[METHOD_TEXT];  /* the same for names of files: "asbdpt-select-bins" */
    char integrator[32];
    char label[METHOD_TEXT]; /* the same for people: "bins", and in the family without what is on or off */
    unsigned halves;         /* bits of the halves of the family that it belongs to; 0: of none */
};

struct methods {
    struct measured item[METHODS_MAX]; /* [n] */
    int n;
};

/* What is measured unless somebody says otherwise; the others are compared with the first. */
#define METHODS_EXPERIMENT METHOD_PRINTED_BDPT ",asbdpt:select=bins/pool/vertices/subspaces"
#define METHODS_EQUAL_TIME "bdpt,asbdpt:select=vertices/subspaces,lvc,cbdpt"
#define METHODS_OWN_SCENE "bdpt,asbdpt"
#define METHODS_CORPUS "bdpt,pt,asbdpt,bdpt:lightsamplestrategy=power,pt:lightsamplestrategy=power"
#define METHODS_BENCH "pt", "bdpt", "asbdpt"
#define SWEEPS_FULL "asbdpt:select=bins:binpaths=4/8/16/32", "asbdpt:select=bins:restart=0/8/16/32"
#define SWEEPS_QUICK "asbdpt:select=bins:binpaths=8/32", "asbdpt:select=bins:restart=0/32"
#define METHODS_ALSO \
    ",ris:weights=counts,lvc:connections=0,lvc:connections=1,mbdpt:key=throughput,cbdpt:connections=1," \
    "asbdpt:select=subspaces:connections=1:pathpixels=1" /* family */
#define METHOD_REFERENCE "bdpt"         /* renders references */
#define METHOD_CAUSTICS "caustics"      /* the same, where reference_method says so */
#define METHOD_PARTNER "asbdpt"         /* of METHOD_REFERENCE in verify, if the scene names no other */
#define METHOD_PRINTED "asbdpt:select=bins" /* the dissertation's asbdpt, and its bdpt: lights by power */
#define METHOD_PRINTED_BDPT "bdpt:lightsamplestrategy=power"

#define METHODS_HELP "what is compared, as NAME:PARAMETER=VALUE:..., values like 4/8"

/* method_is_chain: are its samples mutations of others, of no pixel and not independent? method_merges: is what it adds
 * to a pixel of many paths at once, as by density estimation, or by the weights of whole passes? */
bool method_is_chain(const struct method *m);
bool method_merges(const struct method *m);

/* method_observable: can it be told what each sample of a pixel is made of? False with a message if not. */
bool method_observable(const struct method *m, struct error *err);

/* method_why: for trace: how it chooses what it joins to an eye sub-path, of methods that nobody has described here
 * their `help`; NULL: it does not choose. */
const char *method_why(const struct method *m);

/* method_named: the first row of that name; NULL if there is none. method_of: the row that the scene's settings choose.
 */
const struct method *method_named(const char *name);
const struct method *method_of(const struct scene *scene, const char *name);

/* render_by: settle a job and render it. render_prepare: settle a job for these pixels of the scene, and prepare it.
 * After success method_release(prepared) must follow. Both return false with a message. */
bool render_by(const struct scene *scene, const struct render_job *o, struct film *film, struct error *err);
bool render_prepare(const struct scene *scene, const struct render_job *options, struct pixel_rect rect,
                    struct render_job *job, struct prepared *prepared, struct error *err);

/* methods_read: a list. False with a message on an integrator, a parameter or a value that does not exist, and if a
 * method is given twice. */
bool methods_read(const char *text, struct methods *out, struct error *err);

/* methods_all: such a list of all there are, METHOD_REFERENCE first; it leaves room for some more. */
enum { METHODS_TEXT = 8192 };
void methods_all(char out[METHODS_TEXT]);

/* The family has two halves: methods that differ in the choice alone, all services off; and each with every service
 * that it can have. methods_add_halves: a list as methods_read takes it, each of its methods as it is in these halves
 * (a method without services is the same in both); false with a message. methods_find_half: the number of the method
 * that is this one in a half, or as it was given in a list without halves, or -1. */
enum half { HALF_CHOICE, HALF_SERVICES, N_HALVES };
extern const char *const HALVES[N_HALVES];
bool methods_add_halves(const char *text, unsigned halves, struct methods *out, struct error *err);
int methods_find_half(const struct methods *list, const char *text, enum half half);

/* method_short: "subspaces" of "asbdpt:select=subspaces". */
const char *method_short(const char *text);

/* methods_find: the number of the method of that text, or -1. */
int methods_find(const struct methods *list, const char *text);

/* measured_biased: does its help say that it is biased? */
bool measured_biased(const struct measured *m);

/* measured_settings: its settings, over those of `base` (NULL: none). To be given to settings_clear. */
struct settings measured_settings(const struct measured *m, const struct settings *base);

#endif
