"""recompute.py: the stored tables of error times CPU time, computed again from the stored runs, by code that shares
nothing with the awk programs that made them. Run from the top; needs Python 3 alone.
    python3 test/measure/recompute.py
Entries whose runs are those of corpus_run.sh (corpus, forty, rivals): quantiles, means, shares, by set and by runner.
Others, whose runs are those of `asbdpt-lab family` and `equal-time`: the row of means, intervals and losses over
the better of bdpt and pt, and the line of each scene. Then a run and a number are changed, each of which must be noticed.
Prints what differs, and how many numbers were compared; exit status 0 only if all agree.
"""
import functools
import math
import re
import sys

MEASURES = ("mse8", "relmse", "8x8")


def blocks(path):
    """The text below each line "=== NAME" of a file, as lists of lines."""
    found = {}
    for line in open(path, encoding="utf-8"):
        if line.startswith("=== "):
            lines = found.setdefault(line[4:].strip(), [])
        else:
            lines.append(line.rstrip("\n"))
    return found


def sections(lines):
    """The lines below each line "== SECTION" of an entry."""
    found, part = {}, []
    for line in lines:
        if line.startswith("== "):
            part = found.setdefault(line[3:], [])
        else:
            part.append(line)
    return found


def cells(line):
    return [cell.strip() for cell in line.strip("|").split("|")]


def mean(x):
    return sum(x) / len(x)


def quantile(x, share):
    """Between neighbours of the sorted values, in proportion."""
    x, at = sorted(x), (len(x) - 1) * share
    low = math.floor(at)
    return x[low] + (at - low) * (x[min(low + 1, len(x) - 1)] - x[low])


@functools.lru_cache(maxsize=None)
def student(n):
    """What Student's t with n degrees of freedom exceeds with 2.5 per cent: bisection of Simpson's rule."""
    c = math.exp(math.lgamma((n + 1) / 2) - math.lgamma(n / 2)) / math.sqrt(n * math.pi)

    def below(t, steps=2000):
        h = t / steps
        f = [c * (1 + (i * h) ** 2 / n) ** (-(n + 1) / 2) for i in range(steps + 1)]
        return h / 3 * (f[0] + f[-1] + 4 * sum(f[1:-1:2]) + 2 * sum(f[2:-1:2]))

    low, high = 1.0, 13.0
    while high - low > 1e-6:
        middle = (low + high) / 2
        low, high = (middle, high) if below(middle) < 0.475 else (low, middle)
    return low


def interval(ratios):
    """Geometric mean and, of five ratios or more, its 95 per cent interval."""
    logs = [math.log(r) for r in ratios]
    m, n = mean(logs), len(logs)
    if n < 5:
        return [math.exp(m)]
    by = student(n - 1) * math.sqrt(sum((x - m) ** 2 for x in logs) / (n - 1) / n)
    return [math.exp(m), math.exp(m - by), math.exp(m + by)]


class Checker:
    def __init__(self, quiet=False):
        self.compared, self.wrong, self.quiet = 0, 0, quiet

    def same(self, where, stored, computed):
        """Is each number of the stored text the computed one, to its last place (and rounding of the runs)?"""
        numbers = re.findall(r"-?[\d,]*\.?\d+(?:e[+-]?\d+)?", stored)
        self.compared += len(computed)
        for text, value in zip(numbers, computed):
            plain = text.replace(",", "")
            digits = plain.split("e")[0]
            place = 10.0 ** -len(digits.partition(".")[2]) * 10.0 ** int((plain.split("e") + ["0"])[1])
            if "," in text or (float(plain) >= 100 and "." not in plain and "e" not in plain):
                place = 10.0 ** (math.floor(math.log10(float(plain))) - 1)  # two digits
            if not abs(float(plain) - value) <= 0.51 * place + 0.0004 * abs(value):
                break
        else:
            if len(numbers) == len(computed):
                return
        self.wrong += 1
        if not self.quiet:
            print(f"{where}: stored {stored}, of the runs", " ".join(f"{v:.4g}" for v in computed))


def read_corpus(lines, first):
    """Of lines of corpus_run.sh: sets, runners, and by scene and method lists of (seconds, errors, misses light)."""
    sets, runner, runs = {}, {}, {}
    for field in (line.split(",")[first:] for line in lines):
        if field[1] == "set":
            sets[field[0]] = field[2]
        elif field[1] == "scene":
            runner[field[0]] = dict(f.split("=") for f in field[6:13])["runner"]
        elif field[1] == "run":
            run = float(field[5]), [float(f) for f in field[6:9]], field[10:11] == ["misses light"]
            runs.setdefault((field[0], field[2]), []).append(run)
    return sets, runner, runs


def cost(runs, k):
    """Error times CPU time by measure k; 3: the error by mse8; 4: the time. None without runs, or if light is missed."""
    if not runs or any(misses for _, _, misses in runs):
        return None
    time = mean([seconds for seconds, _, _ in runs])
    return time if k == 4 else mean([errors[k % 3] for _, errors, _ in runs]) * (1 if k == 3 else time)


def check_corpus(check, name, lines, stored):
    sets, runner, runs = read_corpus(lines, 0)

    def ratio(scene, k, methods=("pt", "bdpt")):
        ours = cost(runs.get((scene, "asbdpt")), k)
        seen = any(mean([e[0] for _, e, _ in runs.get((scene, m)) or [(0, [0], 0)]]) > 0.01 for m in ("pt", "bdpt"))
        others = [runs.get((scene, m)) for m in methods]
        better = min((c for c in (cost(other, k) for other in others) if c), default=None)
        return ours / better if seen and ours and better else None

    scenes = list(dict.fromkeys(scene for scene, _ in runs if scene in runner))
    over = {"over `pt`": ("pt",), "over `bdpt`": ("bdpt",)}
    for title in ("sets", "runners", "baselines"):
        for line in stored[title][2:]:
            label, measure, *numbers = cells(line)
            chosen = [s for s in scenes if label in ("both", sets[s], runner[s]) or title == "baselines" and
                      sets[s] == "report"]
            x = [ratio(s, MEASURES.index(measure), over.get(label, ("pt", "bdpt"))) for s in chosen]
            x = [v for v in x if v]
            shares = [quantile(x, q / 100) for q in (10, 25, 50, 75, 90, 100)]
            ends = [100 * mean([v > 1.15 for v in x]), 100 * mean([v < 0.87 for v in x])]
            check.same(f"{name} {label} {measure}", " ".join(numbers), [len(x), interval(x)[0], *shares, *ends])
    for line in stored["quartiles"][2:]:
        measure, *numbers = cells(line)
        x = [ratio(s, MEASURES.index(measure)) for s in scenes if sets[s] == "report"]
        x = [v for v in x if v]
        check.same(f"{name} {measure}", " ".join(numbers), [quantile(x, q / 100) for q in (25, 50, 75, 90, 100)])


def check_rivals(check, name, lines, stored):
    for half, title in (("services", "techniques"), ("choice", "alone")):
        runs = read_corpus([line for line in lines if line.startswith(half + ",")], 1)[2]
        scenes = list(dict.fromkeys(scene for scene, _ in runs))

        def noise(scene):  # where none is seen, times are not compared, either
            return cost(runs.get((scene, "asbdpt")), 3)

        def ratios(rival, k):
            both = [(cost(runs.get((s, "asbdpt")), k), cost(runs.get((s, rival)), k)) for s in scenes]
            return [max(a / b, 0.0005) for s, (a, b) in zip(scenes, both) if a and b and noise(s)]

        for line in stored[title][2:]:
            rival, n, *numbers = cells(line)
            x = [ratios(rival.strip("`"), k) for k in range(5)]
            shares = [math.exp(quantile([math.log(v) for v in x[0]], q / 100)) for q in (25, 50, 75)]
            apart = [interval(x[k])[0] for k in (3, 4)]
            row = [len(x[0]), *interval(x[0]), *apart, *shares, max(x[0])]
            for k in (1, 2):
                row += interval(x[k]) + [math.exp(quantile([math.log(v) for v in x[k]], 0.5))]
            check.same(f"{name} {title} {rival}", f"{n} " + " ".join(numbers), row)


def check_equal(check, name, lines, stored):
    """Tables of runs of equal time: the last group of runs, each error times the seconds of its own render."""
    head, *rows = [line.split(",") for line in lines if line]
    rows = [dict(zip(head, row)) for row in rows]
    group = [row.get("part") or row["half"] for row in rows]
    rows = [row for row, g in zip(rows, group) if g == group[-1]]
    unknown = [line.split() for line in stored.get("unknown", [])]
    unknown = {tuple(x[:3]) for x in unknown if x[3:] in ([], group[-1:])}

    def runs(scene, method, k):
        x = [r for r in rows if r["scene"] == scene and r["label"].replace("subspaces", "asbdpt") == method]
        if not x or any((scene, m, MEASURES[k]) in unknown for m in (method, method.replace("asbdpt", "subspaces"))):
            return None
        first = [r for r in rows if r["scene"] == scene and r["label"] == rows[0]["label"]]
        for r, f in zip(x, first):  # could it render a sample in the time?
            time = float(f["price_before"]) + float(f["spp"]) * float(f["price_each"])
            if time - float(r["price_before"]) < float(r["price_each"]):
                return None
        value = mean([float(r[("mse8", "relmse", "relmse8x8")[k]]) * float(r["seconds"]) for r in x])
        return value if value > 0 else None

    def ratio(scene, k):
        ours, bdpt, pt = (runs(scene, method, k) for method in ("asbdpt", "bdpt", "pt"))
        marks = {r["label"].replace("subspaces", "asbdpt"): r["mark"] for r in rows if r["scene"] == scene}
        counts = not marks.get("pt") or marks.get("asbdpt")
        if not ours or not bdpt:
            return None
        return max(ours / (pt if pt and counts and pt < bdpt else bdpt), 0.0005)

    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    texts, losses = stored["row"][0].split(" | "), stored["row"][0].split(" | ")[3].split(", ")
    for k in range(3):
        x = [v for v in (ratio(s, k) for s in scenes) if v]
        check.same(f"{name} row {MEASURES[k]}", texts[k], interval(x))
        check.same(f"{name} losses {MEASURES[k]}", losses[k], [sum(v > 1.005 for v in x)] +
                   ([len(x)] if "of" in losses[k] else []))
    for line in stored.get("data", []):
        scene, *numbers = line.split()
        for k in range(3):
            v = ratio(scene, k)
            check.same(f"{name} {scene} {MEASURES[k]}", numbers[3 * k], [v] if v else [])


def check_all(runs, numbers, only=None):
    """All entries; or one, without a word."""
    check = Checker(only is not None)
    for name in [only] if only else runs:
        lines = runs[name]
        stored = sections(numbers[name])
        if "sets" in stored:
            check_corpus(check, name, lines, stored)
        elif "techniques" in stored:
            check_rivals(check, name, lines, stored)
        elif "row" in stored:
            check_equal(check, name, lines, stored)
    return check


def changed(texts, name, pattern, change):
    """A copy in which the first line of an entry that has the pattern is another one."""
    at = next(i for i, line in enumerate(texts[name]) if re.search(pattern, line))
    lines = list(texts[name])
    lines[at] = change(lines[at])
    return {**texts, name: lines}


def main():
    runs, numbers = blocks("doc/measured/runs.txt"), blocks("doc/measured/numbers.txt")
    check = check_all(runs, numbers)
    ok = check.wrong == 0 and check.compared > 500

    def times_four(line):
        field = line.split(",")
        field[6] = str(float(field[6]) * 4)
        return ",".join(field)

    faults = [("corpus", changed(runs, "corpus", ",run,asbdpt,", times_four), numbers),
              ("gains", changed(runs, "gains", ",subspaces,", times_four), numbers),
              ("rivals", runs, changed(numbers, "rivals", "^.*`lvc`", lambda line: line.replace("| 39 |", "| 38 |"))),
              ("forty", runs, changed(numbers, "forty", "report . relmse", lambda line: re.sub(r"(\d)\.", r"1\1.", line, count=1)))]
    for name, *fault in faults:
        if check_all(*fault, only=name).wrong == 0:
            print(f"recompute: the fault planted in {name} is not noticed")
            ok = False
    print(f"recompute: {check.compared} numbers computed again, {check.wrong} differ, {len(faults)} planted faults")
    return 0 if ok else 1


sys.exit(main())
