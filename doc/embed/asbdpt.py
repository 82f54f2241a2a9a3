"""asbdpt.py: the library for Python, by ctypes alone; numpy arrays where numpy is there.

    import asbdpt
    r = asbdpt.Render("scenes/cornell-box.pbrt", integrator="bdpt", res="64", P=["maxdepth=3"])
    r.render(16)
    picture = r.picture()   # [height, width, 3]; without numpy a flat array of floats
    print(r.statistics()["cpu_seconds"])

ASBDPT_LIBRARY names the shared library (make lib), if it is not build/libasbdpt.so of this tree. asbdpt.h has the whole
contract; an error is an asbdpt.Error with its message.
"""
import ctypes as c
import json
import os

try:
    import numpy
except ImportError:
    numpy = None

_tree = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "build", "libasbdpt.so")
_lib = c.CDLL(os.environ.get("ASBDPT_LIBRARY", _tree))

CONTINUE, END_BLOCK, STOP = range(3)  # what cancel returns


class Error(Exception): pass


class Vertex(c.Structure):
    _fields_ = [("kind", c.c_int), ("p", c.c_double * 3), ("n", c.c_double * 3), ("beta", c.c_double * 3),
                ("pdf", c.c_double)]


class Path(c.Structure):
    _fields_ = [("s", c.c_int), ("t", c.c_int), ("x", c.c_int), ("y", c.c_int), ("sample", c.c_long),
                ("px", c.c_double), ("py", c.c_double), ("value", c.c_double * 3), ("weight", c.c_double),
                ("vertex", c.POINTER(Vertex)), ("n", c.c_int)]


class Parameter(c.Structure):
    _fields_ = [("method", c.c_char_p), ("select", c.c_char_p), ("name", c.c_char_p), ("help", c.c_char_p),
                ("fallback", c.c_char * 64)]


_PROGRESS = c.CFUNCTYPE(None, c.c_void_p, c.c_double, c.c_double)
_CANCEL = c.CFUNCTYPE(c.c_int, c.c_void_p)
_OBSERVER = c.CFUNCTYPE(None, c.c_void_p, c.POINTER(Path))
_lib.asbdpt_new.restype = c.c_void_p
_lib.asbdpt_samples.restype = c.c_double
for _name in ("message", "statistics"):
    getattr(_lib, "asbdpt_" + _name).restype = c.c_char_p


def parameters():
    """All methods, and their parameters: dictionaries; `name` None: the method itself."""
    out, p = [], Parameter()
    while _lib.asbdpt_parameter(len(out), c.byref(p)):
        text = {name: getattr(p, name) for name, _ in Parameter._fields_}
        out.append({name: value.decode() if value is not None else None for name, value in text.items()})
    return out


class Render:
    def __init__(self, scene, text=None, keep_error=False, **options):
        """A scene file, or the text of one, whose name `scene` then stands for. Options are those of the command line:
        spp=16, seed=1, nthreads=1, quick=True, max_memory=2, P=["race=off", "later=2"]."""
        self._r = c.c_void_p(_lib.asbdpt_new())
        self._observer = None
        for name, values in options.items():
            option = "-P" if name == "P" else "--" + name.replace("_", "-")
            for value in values if isinstance(values, (list, tuple)) else [values]:
                self._call("set", option.encode(), None if value is True else str(value).encode())
        if text is None:
            self._call("open", os.fsencode(scene))
        else:
            self._call("open_text", os.fsencode(scene), text.encode(), c.c_size_t(len(text.encode())))
        width, height = c.c_int(), c.c_int()
        self._call("size", c.byref(width), c.byref(height))
        self.width, self.height = width.value, height.value
        if keep_error:
            self._call("keep_error")

    def __del__(self):
        if getattr(self, "_r", None):
            _lib.asbdpt_free(self._r)

    def _call(self, name, *arguments):
        if getattr(_lib, "asbdpt_" + name)(self._r, *arguments):
            raise Error(_lib.asbdpt_message(self._r).decode(errors="replace"))

    def render(self, samples=0, progress=None, cancel=None):
        """progress(learnt, done); cancel() returns CONTINUE, END_BLOCK or STOP. Both are called by any thread."""
        told = _PROGRESS(lambda _, learnt, done: progress(learnt, done)) if progress else _PROGRESS()
        asked = _CANCEL(lambda _: cancel()) if cancel else _CANCEL()
        self._call("render", c.c_long(samples), told, asked, None)

    def _values(self, name):
        values = (c.c_float * (self.width * self.height * 3))()
        self._call(name, values)
        return values if numpy is None else numpy.array(values).reshape(self.height, self.width, 3)

    def picture(self):
        return self._values("read")

    def error(self):
        return self._values("error")

    def samples(self):
        return _lib.asbdpt_samples(self._r)

    def statistics(self):
        return json.loads(_lib.asbdpt_statistics(self._r).decode())

    def save(self, path, how="save"):
        """Or how="save_checkpoint" and "load_checkpoint"."""
        self._call(how, os.fsencode(path))

    def observe(self, observer):
        """observer(path) of every path; the path is valid during the call. None: nobody."""
        self._observer = _OBSERVER(lambda _, path: observer(path.contents)) if observer else _OBSERVER()
        self._call("observe", self._observer, None)
