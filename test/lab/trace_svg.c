/* trace_svg.c: a pixel sample as a drawing: its paths within the scene, from the camera and from above.
 *
 * What the scene looks like is found with rays. From the camera: where neighbouring first hits differ in material or
 * direction, or do not lie on one plane, there is a line. From above: a horizontal section at the height of the
 * camera, as in an architect's plan, every surface met within that plane being a point; and lines as before of what
 * lies below it.
 */
#include <stdlib.h>
#include <string.h>

#include "lab/trace.h"

enum { WIDTH = 560, MARGIN = 20, TOP = 64, CELLS = 320, PIECES = 48 };
static const char BLUE[] = "#1d5fbf", ORANGE[] = "#d97a00", GREEN[] = "#1a8f4c", GREY[] = "#8a8a8a";

/* Names of vertices that are drawn already, as boxes: left, top, right, bottom. */
enum { MAX_LABELS = 64 };
struct labels {
    double box[MAX_LABELS][4];
    int n;
};

/* A picture of the scene: raster points, `cells` of them along x, and where points of the scene come to lie. */
struct view {
    const struct scene *scene;
    int nx, ny;            /* cells */
    double scale;          /* SVG units per cell */
    bool plan;             /* from above */
    vec3 origin, x, y, up; /* plan: the corner, cells to the right and downwards; unit */
    struct labels *labels; /* that are in it */
};

/* --- where things are -------------------------------------------------------------------------------- */

static bool project(const struct view *v, vec3 p, double *x, double *y)
{
    if (v->plan) {
        vec3 d = sub(p, v->origin);
        *x = v->scale * dot(d, v->x) / length2(v->x);
        *y = v->scale * dot(d, v->y) / length2(v->y);
        return true;
    }
    const struct camera *c = &v->scene->camera;
    vec3 lens = camera_sample_lens(c, p, 0.5, 0.5), d = sub(p, lens);
    if (!(length2(d) > 0) || camera_project(c, lens, normalize(d), x, y) == 0)
        return false;
    *x *= v->scale * v->nx / v->scene->width;
    *y *= v->scale * v->ny / v->scene->height;
    return true;
}

static struct ray ray_through(const struct view *v, double i, double j)
{
    if (!v->plan)
        return camera_ray(&v->scene->camera, i * v->scene->width / v->nx, j * v->scene->height / v->ny, 0.5, 0.5);
    vec3 p = add(v->origin, add(mul(v->x, i), mul(v->y, j)));
    struct ray ray = {p, neg(v->up), 0, HUGE_VAL, 0, 0};
    return ray;
}

static struct view camera_view(const struct scene *scene)
{
    struct view v = {.scene = scene, .nx = CELLS};
    v.ny = int_within((double)CELLS * scene->height / scene->width + 0.5, 1, 4 * CELLS);
    v.scale = (double)WIDTH / CELLS;
    return v;
}

/* Everything that the drawing must hold. */
struct extent {
    double lo[3], hi[3];
};

static void extend(struct extent *e, const vec3 axis[3], vec3 p)
{
    for (int i = 0; i < 3; i++) {
        e->lo[i] = fmin(e->lo[i], dot(p, axis[i]));
        e->hi[i] = fmax(e->hi[i], dot(p, axis[i]));
    }
}

static void extend_path(struct extent *e, const vec3 axis[3], const struct scene *scene, const struct trace_path *path)
{
    for (int i = 0; i < path->n; i++) {
        const struct vertex *v = &path->vertex[i];
        if (v->kind == VERTEX_SURFACE || (v->kind == VERTEX_LIGHT && !vertex_at_infinity(scene, v)))
            extend(e, axis, v->p);
    }
}

static double side_of(const struct extent *e) { return fmax(e->hi[0] - e->lo[0], e->hi[1] - e->lo[1]); }

/* The axis of the scene's coordinates that the camera has above it, and level with it its right and its view. */
static void level_axes(const struct camera *c, vec3 axis[3])
{
    vec3 up = transform_vector(&c->camera_to_world, vec(0, 1, 0)), f = c->forward;
    vec3 a = vec(fabs(up.x), fabs(up.y), fabs(up.z));
    axis[2] = a.x > a.y && a.x > a.z ? vec(up.x > 0 ? 1 : -1, 0, 0)
              : a.y > a.z            ? vec(0, up.y > 0 ? 1 : -1, 0)
                                     : vec(0, 0, up.z > 0 ? 1 : -1);
    axis[1] = normalize(sub(f, mul(axis[2], dot(f, axis[2]))));
    if (length2(axis[1]) < 0.5) /* straight up or down */
        axis[1] = fabs(axis[2].x) > 0.5 ? vec(0, 1, 0) : vec(1, 0, 0);
    axis[0] = cross(axis[1], axis[2]);
    if (dot(axis[0], transform_vector(&c->camera_to_world, vec(1, 0, 0))) < 0) /* a camera that is mirrored */
        axis[0] = neg(axis[0]);
}

/* All vertices; and the camera, unless it would make them small, or they are next to nothing. */
static struct extent extent_of(const struct scene *scene, const struct trace *t, const vec3 axis[3])
{
    struct extent e = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    extend_path(&e, axis, scene, &t->eye);
    for (int i = 0; i < t->n_lights; i++)
        extend_path(&e, axis, scene, &t->light[i]);
    struct extent all = e;
    extend(&all, axis, scene->camera.position);
    return side_of(&all) < 2 * side_of(&e) || side_of(&all) > 6 * side_of(&e) ? all : e;
}

/* The camera looks up the page. */
static struct view plan_view(const struct scene *scene, const struct trace *t)
{
    struct view v = {.scene = scene, .plan = true};
    vec3 axis[3];
    level_axes(&scene->camera, axis);
    struct extent e = extent_of(scene, t, axis);
    double side = 1.4 * fmax(side_of(&e), 1e-6 * scene->lights.radius), cell = side / CELLS;
    v.nx = v.ny = CELLS;
    v.scale = (double)WIDTH / CELLS;
    v.x = mul(axis[0], cell);
    v.y = mul(axis[1], -cell);
    v.up = axis[2];
    v.origin = add(add(mul(axis[0], (e.lo[0] + e.hi[0] - side) / 2), mul(axis[1], (e.lo[1] + e.hi[1] + side) / 2)),
                   mul(axis[2], dot(axis[2], scene->camera.position)));
    return v;
}

/* --- the scene --------------------------------------------------------------------------------------- */

/* Are these first hits of neighbouring rays the same to the eye? */
static bool same(const struct surface *a, const struct surface *b, bool hit_a, bool hit_b)
{
    if (!hit_a || !hit_b)
        return hit_a == hit_b;
    double apart = length(sub(a->p, b->p));
    return a->material == b->material && a->light == b->light && abs_dot(a->ng, b->ng) > 0.85 &&
           fmin(abs_dot(a->ng, sub(b->p, a->p)), abs_dot(b->ng, sub(a->p, b->p))) <= 0.3 * apart;
}

/* Lines between cells, each as long as neighbours go on differing. */
static void draw_outlines(FILE *f, const struct view *v)
{
    size_t n = (size_t)v->nx * (size_t)v->ny;
    struct surface *at = mem_alloc(n, sizeof *at);
    bool *hit = mem_alloc(n, sizeof *hit);
    for (int j = 0; j < v->ny; j++)
        for (int i = 0; i < v->nx; i++) {
            struct ray ray = ray_through(v, i + 0.5, j + 0.5);
            hit[j * v->nx + i] = scene_intersect(v->scene, &ray, &at[j * v->nx + i]);
        }
    fprintf(f, "<path class=\"scene\" d=\"");
    for (int across = 0; across < 2; across++) {
        int lines = across ? v->ny : v->nx, length = across ? v->nx : v->ny;
        int step = across ? 1 : v->nx, back = across ? v->nx : 1;
        for (int k = 1; k < lines; k++)
            for (int i = 0, begun = 0, open = 0; i <= length; i++) {
                int cell = k * back + i * step;
                bool edge = i < length && !same(&at[cell], &at[cell - back], hit[cell], hit[cell - back]);
                if (edge && !open)
                    begun = i;
                if (!edge && open)
                    fprintf(f, across ? "M%.1f %.1fh%.1f" : "M%.1f %.1fv%.1f", v->scale * (across ? begun : k),
                              v->scale * (across ? k : begun), v->scale * (i - begun));
                open = edge;
            }
    }
    fprintf(f, "\"/>\n");
    free(at);
    free(hit);
}

/* The section: all that lines within the plane meet, along one direction and the other. */
static void draw_section(FILE *f, const struct view *v)
{
    enum { MOST = 64 };
    fprintf(f, "<path class=\"section\" d=\"");
    for (int across = 0; across < 2; across++)
        for (int k = 0; k < (across ? v->ny : v->nx); k++) {
            vec3 step = across ? v->x : v->y, start = add(v->origin, mul(across ? v->y : v->x, k + 0.5));
            struct ray ray = {start, normalize(step), 0, length(step) * (across ? v->nx : v->ny), 0, 0};
            struct surface at;
            for (int n = 0; n < MOST && scene_intersect(v->scene, &ray, &at); n++) {
                double x, y;
                if (project(v, at.p, &x, &y))
                    fprintf(f, "M%.1f %.1fh0", x, y);
                ray.tmin = length(sub(at.p, start)) + 1e-4 * length(step);
            }
        }
    fprintf(f, "\"/>\n");
}

/* --- the paths --------------------------------------------------------------------------------------- */

/* A straight line of the scene; where it passes behind the camera it is broken. */
static void draw_line(FILE *f, const struct view *v, vec3 a, vec3 b, const char *colour, double width, bool dashed,
                      const char *title)
{
    bool open = false;
    double before = 0;
    fprintf(f, "<path class=\"%s\" stroke=\"%s\" stroke-width=\"%.2f\" d=\"", dashed ? "path none" : "path", colour,
              width);
    for (int i = 0; i <= PIECES; i++) {
        double x = 0, y = 0;
        bool seen = project(v, lerp3((double)i / PIECES, a, b), &x, &y) && fabs(x) < 1e5 && fabs(y) < 1e5;
        bool on = open && seen && fabs(x - before) < WIDTH / 2.0; /* an environment camera's picture has a seam */
        if (seen)
            fprintf(f, on ? "L%.1f %.1f" : "M%.1f %.1f", x, y);
        open = seen;
        before = x;
    }
    fprintf(f, "\"><title>%s</title></path>\n", title);
}

static bool is_free(const struct view *v, const double box[4])
{
    if (box[0] < 0 || box[1] < 0 || box[2] > WIDTH || box[3] > v->scale * v->ny)
        return false;
    for (int i = 0; i < v->labels->n; i++) {
        const double *other = v->labels->box[i];
        if (box[0] < other[2] && other[0] < box[2] && box[1] < other[3] && other[1] < box[3])
            return false;
    }
    return true;
}

/* The name of a vertex at (x,y): next to it where no other name is, or to the upper right if there is no such place. */
static void draw_name(FILE *f, const struct view *v, double x, double y, const char *colour, const char *name)
{
    enum { HEIGHT = 16, AROUND = 12 };
    double width = 10.0 * (double)strlen(name), at[4] = {0};
    for (int i = 0; i < 3 * AROUND; i++) { /* three rings of places, clockwise from the upper right */
        double angle = -PI / 4 + 2 * PI * (i % AROUND) / AROUND, far = 9 + 12 * (i / AROUND);
        double left = x + m_cos(angle) * (far + width / 2) - width / 2;
        double top = y + m_sin(angle) * (far + HEIGHT / 2) - HEIGHT / 2;
        const double box[4] = {left, top, left + width, top + HEIGHT};
        bool fits = is_free(v, box);
        if (fits || i == 0)
            memcpy(at, box, sizeof at);
        if (fits)
            break;
    }
    if (v->labels->n < MAX_LABELS)
        memcpy(v->labels->box[v->labels->n++], at, sizeof at);
    fprintf(f, "<text x=\"%.1f\" y=\"%.1f\" fill=\"%s\">%s</text>\n", at[0], at[3] - 2, colour, name);
}

static void draw_vertex(FILE *f, const struct view *v, vec3 p, const char *colour, const char *name)
{
    double x, y;
    if (!project(v, p, &x, &y))
        return;
    fprintf(f, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\" fill=\"%s\"/>", x, y, colour);
    if (name[0] != '\0')
        draw_name(f, v, x, y, colour, name);
}

/* Where vertex i is drawn: what is infinitely far, a little way in its direction. */
static vec3 place(const struct scene *scene, const struct trace_path *path, int i)
{
    const struct vertex *v = &path->vertex[i];
    double far = 0.3 * scene->lights.radius;
    if (v->kind == VERTEX_ESCAPED)
        return sub(path->vertex[i - 1].p, mul(v->wo, far));
    if (vertex_at_infinity(scene, v))
        return path->n > 1 ? add(path->vertex[1].p, mul(v->wo, far)) : v->p;
    return v->p;
}

/* Does anything come from vertex i of this light sub-path? */
static bool brings(const struct trace *t, int light, int i)
{
    for (int k = 0; k < t->n_connections; k++)
        if (t->connection[k].light == light && t->connection[k].s == i + 1 && !rgb_is_black(t->connection[k].added))
            return true;
    return false;
}

/* A light sub-path, or the eye's if `light` is -1. Where there are many, only what matters has a name. */
static void draw_path(FILE *f, const struct view *v, const struct trace *t, int light)
{
    enum { FEW = 3 };
    const struct trace_path *path = light < 0 ? &t->eye : &t->light[light];
    const char *colour = light < 0 ? BLUE : ORANGE;
    char letter = light < 0 ? 'z' : 'y', name[40];
    bool few = light < 0 || t->n_lights <= FEW;
    if (path->n == 1 && vertex_at_infinity(v->scene, &path->vertex[0]))
        return; /* it is nowhere */
    for (int i = 1; i < path->n; i++) {
        snprintf(name, sizeof name, "%c%d to %c%d", letter, i - 1, letter, i);
        draw_line(f, v, place(v->scene, path, i - 1), place(v->scene, path, i), colour, few ? 1.8 : 0.9, false, name);
    }
    for (int i = 0; i < path->n; i++) {
        snprintf(name, sizeof name, light >= 0 && t->n_lights > 1 ? "%c%d (%d)" : "%c%d", letter, i, light + 1);
        if (few || brings(t, light, i))
            draw_vertex(f, v, place(v->scene, path, i), colour, name);
    }
}

static void draw_connection(FILE *f, const struct view *v, const struct trace *t, const struct trace_connection *c,
                            double most)
{
    char title[120];
    double brought = rgb_luminance(c->added);
    bool nothing = rgb_is_black(c->c.value);
    if (c->s == 0 || (nothing && (c->s == 1 || c->t == 1)))
        return; /* joins nothing, or it is not known where to */
    vec3 z = c->t > 1 ? t->eye.vertex[c->t - 1].p : c->end, y = c->end;
    if (c->s > 1)
        y = t->light[c->light].vertex[c->s - 1].p;
    else if (light_at_infinity(&v->scene->lights.light[c->c.light]))
        y = add(z, mul(c->end, 0.3 * v->scene->lights.radius));
    snprintf(title, sizeof title, "(%d,%d): C* %.3g, weight %.3g, adds %.3g", c->s, c->t, rgb_luminance(c->c.value),
             c->c.weight, brought);
    draw_line(f, v, y, z, nothing ? GREY : GREEN, nothing ? 0.7 : 0.6 + 4 * safe_sqrt(brought / most), nothing, title);
    if (c->s == 1)
        draw_vertex(f, v, y, GREEN, "");
}

static void draw_view(FILE *f, struct view *v, const struct trace *t, double left, const char *title)
{
    struct labels labels = {.n = 0};
    double most = 1e-300;
    v->labels = &labels;
    for (int i = 0; i < t->n_connections; i++)
        most = fmax(most, t->connection[i].t > 1 ? rgb_luminance(t->connection[i].added) : 0);
    fprintf(f, "<text class=\"title\" x=\"%.0f\" y=\"%d\">%s</text>\n", left, TOP - 10, title);
    fprintf(f, "<svg x=\"%.0f\" y=\"%d\" width=\"%d\" height=\"%.0f\">\n", left, TOP, WIDTH, v->scale * v->ny);
    fprintf(f, "<rect width=\"%d\" height=\"%.0f\" fill=\"#fff\" stroke=\"#ccc\"/>\n", WIDTH, v->scale * v->ny);
    draw_outlines(f, v);
    if (v->plan)
        draw_section(f, v);
    for (int i = 0; i < t->n_connections; i++)
        if (t->connection[i].t > 1 || !rgb_is_black(t->connection[i].added))
            draw_connection(f, v, t, &t->connection[i], t->connection[i].t > 1 ? most : HUGE_VAL);
    for (int i = 0; i < t->n_lights; i++)
        draw_path(f, v, t, i);
    draw_path(f, v, t, -1);
    v->labels = NULL;
    fprintf(f, "</svg>\n");
}

/* --- the sheet --------------------------------------------------------------------------------------- */

/* Text as XML wants it. */
static void put_text(FILE *f, const char *text)
{
    for (; *text != '\0'; text++)
        if (*text == '&' || *text == '<')
            fputs(*text == '&' ? "&amp;" : "&lt;", f);
        else
            fputc(*text, f);
}

static void draw_legend(FILE *f, const struct trace_story *s, int height)
{
    static const struct {
        const char *colour, *dashes, *text;
        int x;
    } entries[] = {{BLUE, "", "eye sub-path z", 0}, {ORANGE, "", "light sub-path y", 195},
                   {GREEN, "", "connection, wider if it adds more", 405},
                   {GREY, "4 3", "connection that adds nothing", 790}};
    fprintf(f, "<text class=\"title\" x=\"%d\" y=\"26\">", MARGIN);
    put_text(f, s->scene_path);
    fprintf(f, ", pixel %d,%d, sample %ld, %s</text>\n", s->trace->x, s->trace->y, s->trace->iteration,
            s->integrator->name);
    for (int i = 0; i < 4; i++) {
        int x = MARGIN + entries[i].x;
        fprintf(f, "<path d=\"M%d %dh34\" stroke=\"%s\" stroke-width=\"2.5\" stroke-dasharray=\"%s\"/>", x,
                  height - 18, entries[i].colour, entries[i].dashes);
        fprintf(f, "<text x=\"%d\" y=\"%d\" fill=\"#333\">%s</text>\n", x + 42, height - 12, entries[i].text);
    }
}

void trace_svg(FILE *f, const struct trace_story *s)
{
    struct view camera = camera_view(s->scene), plan = plan_view(s->scene, s->trace);
    int most = camera.ny > plan.ny ? camera.ny : plan.ny;
    int width = 2 * WIDTH + 3 * MARGIN, height = TOP + (int)(camera.scale * most) + 50;
    fprintf(f, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" height=\"%d\">\n", width,
              height, width, height);
    fprintf(f, "<style>text{font:18px sans-serif;paint-order:stroke;stroke:#fff;stroke-width:3px}"
                 ".title{font-size:20px;fill:#222}.scene{stroke:#9a9a9a;stroke-width:.8;fill:none}"
                 ".section{stroke:#333;stroke-width:2.2;stroke-linecap:round}"
                 ".path{fill:none;stroke-linecap:round}.none{stroke-dasharray:4 3}</style>\n");
    fprintf(f, "<rect width=\"%d\" height=\"%d\" fill=\"#fff\"/>\n", width, height);
    draw_view(f, &camera, s->trace, MARGIN, "from the camera");
    draw_view(f, &plan, s->trace, 2 * MARGIN + WIDTH, "from above, cut at the height of the camera");
    draw_legend(f, s, height);
    fprintf(f, "</svg>\n");
}
