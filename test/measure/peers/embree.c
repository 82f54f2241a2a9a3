/* embree.c: rays through the kd-tree and through Embree 3, robust and with one thread: the same rays of the same
 * triangles. Prints of each scene a line: its path, its triangles, then of three queries Mray/s of CPU by the kd-tree,
 * by Embree, and the ratio, which is the median of nine taken in turn. The queries: first hits of incoherent rays
 * (lab/tree.h), any hit of the same, any hit between two places that neighbours of them meet.
 *     build/embree SCENE.pbrt...
 */
#include <embree3/rtcore.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/os.h"
#include "lab/tree.h"
#include "parser/parser.h"

enum query { CLOSEST, ANY, BETWEEN, N_QUERIES };
enum { ROUNDS = 9 };

static RTCScene embree_scene(RTCDevice device, const struct geometry *geo)
{
    RTCScene scene = rtcNewScene(device);
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    float *p = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, (size_t)geo->n_vertices);
    unsigned *index =
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, (size_t)geo->n_triangles);
    for (int i = 0; i < 3 * geo->n_vertices; i++)
        p[i] = geo->P[i];
    for (int i = 0; i < 3 * geo->n_triangles; i++)
        index[i] = geo->index[i];
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    rtcReleaseGeometry(mesh);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene);
    return scene;
}

/* Is anything met? */
static bool embree_meets(RTCScene scene, const struct ray *ray, bool any)
{
    struct RTCIntersectContext context;
    struct RTCRayHit r = {
        .ray = {(float)ray->o.x, (float)ray->o.y, (float)ray->o.z, (float)ray->tmin, (float)ray->d.x, (float)ray->d.y,
                (float)ray->d.z, 0, (float)ray->tmax, UINT32_MAX, 0, 0},
        .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
    rtcInitIntersectContext(&context);
    if (any)
        rtcOccluded1(scene, &context, &r.ray);
    else
        rtcIntersect1(scene, &context, &r);
    return any ? r.ray.tfar < 0 : r.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

/* Seconds of CPU that n rays take, by Embree if there is a scene of it. *met: how many meet something. */
static double trace(const struct scene *s, RTCScene scene, const struct ray *ray, int n, bool any, int *met)
{
    struct hit hit;
    double start = os_cpu_seconds();
    *met = 0;
    for (int i = 0; i < n; i++)
        *met += scene != NULL ? embree_meets(scene, &ray[i], any)
                : any         ? kd_occluded(&s->kd, &s->geo, &ray[i], INFINITY)
                              : kd_closest(&s->kd, &s->geo, &ray[i], &hit);
    return os_cpu_seconds() - start;
}

/* Replace rays by segments between the hits of neighbours. Returns how many there are. */
static int join(const struct scene *s, struct ray *ray, int n)
{
    int n_out = 0;
    struct surface at, before = {.light = -1};
    for (int i = 0; i < n; i++) {
        struct ray r = ray[i];
        if (!scene_intersect(s, &r, &at))
            continue;
        vec3 way = sub(at.p, before.p);
        double far = length(way);
        if (i > 0 && far > 0)
            ray[n_out++] = (struct ray){before.p, mul(way, 1 / far), 1e-4 * far, (1 - 1e-4) * far,
                                        before.prim_id, at.prim_id};
        before = at;
    }
    return n_out;
}

static int by_value(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* False if they do not agree: one hit in a hundred may be of rounding. */
static bool compare(const struct scene *s, RTCScene scene)
{
    struct ray *ray = mem_alloc(N_RAYS, sizeof *ray);
    int n = bench_rays(s, ray);
    bool agree = true;
    for (int query = 0; query < N_QUERIES; query++) {
        double ours[ROUNDS], theirs[ROUNDS], ratio[ROUNDS];
        int met[2];
        n = query == BETWEEN ? join(s, ray, n) : n;
        for (int i = 0; i < ROUNDS; i++) {
            ours[i] = trace(s, NULL, ray, n, query != CLOSEST, &met[0]);
            theirs[i] = trace(s, scene, ray, n, query != CLOSEST, &met[1]);
            ratio[i] = theirs[i] / ours[i];
        }
        qsort(ours, ROUNDS, sizeof *ours, by_value);
        qsort(theirs, ROUNDS, sizeof *theirs, by_value);
        qsort(ratio, ROUNDS, sizeof *ratio, by_value);
        printf(" %.3g %.3g %.2f", 1e-6 * n / ours[ROUNDS / 2], 1e-6 * n / theirs[ROUNDS / 2], ratio[ROUNDS / 2]);
        agree = agree && abs(met[0] - met[1]) <= n / 100;
    }
    printf("\n");
    free(ray);
    return agree;
}

int main(int argc, char **argv)
{
    RTCDevice device = rtcNewDevice("threads=1");
    for (int i = 1; i < argc; i++) {
        struct scene s;
        struct error err;
        if (!parse_scene(argv[i], NULL, &s, NULL, &err)) {
            fprintf(stderr, "%s\n", err.text);
            return 1;
        }
        scene_prepare(&s);
        RTCScene scene = embree_scene(device, &s.geo);
        printf("%s %d", argv[i], s.geo.n_triangles);
        if (!compare(&s, scene))
            fprintf(stderr, "%s: Embree meets another number of triangles\n", argv[i]);
        rtcReleaseScene(scene);
        scene_free(&s);
    }
    rtcReleaseDevice(device);
    return 0;
}
