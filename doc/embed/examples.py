"""examples.py [DIR]: three measurements by the library, each a picture in DIR (out/embed). Run it from the top, after
make lib.

    errors       error against samples of three methods
    weights      the weights of the paths of one sample, by strategy
    strategies   where each strategy (s,t) contributes
"""
import os
import struct
import sys
import zlib

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import asbdpt

SCENE, SPOT = "scenes/cornell-box.pbrt", "scenes/spot.pbrt"
COLOURS = [(200, 60, 50), (50, 110, 200), (40, 150, 80), (160, 90, 180), (220, 150, 40)]


def write_png(path, width, height, pixels):
    """pixels: [height*width] of three bytes."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + b"".join(bytes(p) for p in pixels[y * width:(y + 1) * width]) for y in range(height))
    with open(path, "wb") as f:
        f.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def box(pixels, width, x0, y0, x1, y1, colour):
    for y in range(int(y0), int(y1)):
        for x in range(int(x0), int(x1)):
            pixels[y * width + x] = colour


def flat(values, most=1e30):
    return [min(float(v), most) for v in (values.ravel() if hasattr(values, "ravel") else values)]


def errors(directory, size=24, most=32):
    """Root mean square error of three methods over the mean, of values up to 1: it falls as the root of the samples."""
    options = {"res": size, "filter": "box", "P": ["maxdepth=4"]}
    truth = asbdpt.Render(SPOT, integrator="bdpt", seed=99, **options)
    truth.render(32 * most)
    right, found = flat(truth.picture(), 1), {}
    mean = sum(right) / len(right)
    for method in ("pt", "bdpt", "asbdpt"):
        r = asbdpt.Render(SPOT, integrator=method, **options)
        while r.samples() < most:
            r.render(max(1, int(r.samples())))  # 1, 2, 4 ... samples in all
            square = sum((a - b) ** 2 for a, b in zip(flat(r.picture(), 1), right)) / len(right)
            found.setdefault(method, []).append((int(r.samples()), square ** 0.5 / mean))
    width, height = 320, 240
    pixels = [(255, 255, 255)] * (width * height)
    low, high = min(e for m in found.values() for _, e in m), max(e for m in found.values() for _, e in m)
    for colour, points in zip(COLOURS, found.values()):
        for n, e in points:  # both axes logarithmic
            x = 20 + 270 * (n.bit_length() - 1) / (most.bit_length() - 1)
            y = 20 + 190 * bits(high / e) / bits(high / low)
            box(pixels, width, x, y, x + 6, y + 6, colour)
    write_png(os.path.join(directory, "errors.png"), width, height, pixels)
    return found


def bits(x):
    """The logarithm to the base 2 of x >= 1."""
    n = 0
    while x >= 2:
        x, n = x / 2, n + 1
    return n + x - 1  # straight between powers


def weights(directory, x=6, y=5, edges=4):
    """Of one sample, the paths of so many edges: the weight of each strategy's, and what the others get."""
    found = {}

    def take(path):
        if (path.x, path.y, path.sample) == (x, y, 0) and path.s + path.t == edges + 1:
            found[path.s, path.t] = path.weight
    r = asbdpt.Render(SCENE, integrator="bdpt", res=24, nthreads=1, P=["maxdepth=%d" % edges, "rrthreshold=0"])
    r.observe(take)
    r.render(1)
    width, height = 40 * (edges + 1), 120
    pixels = [(255, 255, 255)] * (width * height)
    for s in range(edges + 1):
        weight = found.get((s, edges + 1 - s))
        if weight is not None:
            box(pixels, width, 40 * s + 5, 10, 40 * s + 35, 110, (225, 225, 225))
            box(pixels, width, 40 * s + 5, 110 - 100 * weight, 40 * s + 35, 110, COLOURS[s % 5])
    write_png(os.path.join(directory, "weights.png"), width, height, pixels)
    return found


def strategies(directory, size=32, samples=16, edges=3):
    """A picture of each strategy's weighted contributions; with a box filter their sum is the picture."""
    sums = {}

    def take(path):
        x, y = (int(path.px), int(path.py)) if path.t == 1 else (path.x, path.y)
        if 0 <= x < size and 0 <= y < size:
            to = sums.setdefault((path.s, path.t), [0.0] * (3 * size * size))
            for i in range(3):
                to[3 * (y * size + x) + i] += path.value[i] * path.weight / samples
    r = asbdpt.Render(SCENE, integrator="bdpt", res="%dx%d" % (size, size), filter="box", nthreads=1,
                      P=["maxdepth=%d" % (edges - 1)])
    r.observe(take)
    r.render(samples)
    width, height = size * (edges + 1), size * edges  # a row for each length, a column for each s
    pixels = [(30, 30, 30)] * (width * height)
    for (s, t), values in sums.items():
        for i in range(size * size):
            shown = tuple(int(255 * min(1, max(0, v)) ** (1 / 2.2)) for v in values[3 * i:3 * i + 3])
            pixels[((s + t - 2) * size + i // size) * width + s * size + i % size] = shown
    write_png(os.path.join(directory, "strategies.png"), width, height, pixels)
    total = [sum(v) for v in zip(*sums.values())]
    return max(abs(a - b) for a, b in zip(total, flat(r.picture()))), sorted(sums)


if __name__ == "__main__":
    out = sys.argv[1] if len(sys.argv) > 1 else "out/embed"
    os.makedirs(out, exist_ok=True)
    for name, points in errors(out).items():
        print("errors", name, " ".join("%d:%.3f" % p for p in points))
    for (s, t), weight in sorted(weights(out).items()):
        print("weights s=%d t=%d %.4f" % (s, t, weight))
    print("strategies: the sum differs by at most %.2g; %s" % strategies(out))
