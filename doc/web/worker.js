// worker.js: runs the renderer, a WebAssembly program for WASI preview 1, with files that lie in memory. Only what the
// program asks for is here; everything else answers "no such function".
//
// In:  { wasm, files: { path: bytes }, call: "web_begin" or "web_command", words: [...] }, once;
//      { held: whether to compute no further }, at any time of a render that has begun.
// Out: { learnt } now and then while it learns; { picture, pixels, width, height, iterations, seconds, rmse8, ratio }
//      after every web_step, and within the first;
//      { status, out, err, files: those written } at the end.
'use strict';

const SUCCESS = 0, BADF = 8, EXIST = 20, INVAL = 28, NOENT = 44, NOSYS = 52;
const CHARACTERS = 2, DIRECTORY = 3, REGULAR = 4;

let held = false, awake = null; // what a render that is held waits for
const hold = on => {
  held = on;
  if (!held && awake)
    awake();
};
// To hear messages a worker must return to its events.
const listen = async () => {
  await new Promise(done => setTimeout(done));
  while (held)
    await new Promise(done => { awake = done; });
};

async function run({ wasm, files, call, words }, show) {
  let memory;
  const view = () => new DataView(memory.buffer);
  const bytes = (at, n) => new Uint8Array(memory.buffer, at, n);
  const text = (at, n) => new TextDecoder().decode(bytes(at, n).slice());
  const store = new Map(Object.entries(files)), written = new Set();
  const said = { 1: '', 2: '' };
  const open = new Map([[0, {}], [1, {}], [2, {}], [3, { path: '' }]]); // 3: the directory that holds all files
  const exists = path => store.has(path);
  const isDirectory = path =>
    path === '' || path === '.' || [...store.keys()].some(name => name.startsWith(path + '/'));

  // A file grows by doubling; `size` is what it holds.
  const put = (path, data) => store.set(path, data);
  const append = (file, piece) => {
    const end = file.at + piece.length;
    if (end > file.data.length) {
      const larger = new Uint8Array(Math.max(end, 2 * file.data.length, 4096));
      larger.set(file.data.subarray(0, file.size));
      file.data = larger;
    }
    file.data.set(piece, file.at);
    file.at = end;
    file.size = Math.max(file.size, end);
    put(file.path, file.data.subarray(0, file.size));
  };
  const pieces = (iovs, n) => Array.from({ length: n }, (_, i) =>
    [view().getUint32(iovs + 8 * i, true), view().getUint32(iovs + 8 * i + 4, true)]);
  const fileStat = (at, kind, size) => {
    bytes(at, 64).fill(0);
    view().setUint8(at + 16, kind);
    view().setBigUint64(at + 32, BigInt(size), true);
    return SUCCESS;
  };

  const wasi = {
    proc_exit(code) { throw { exit: code }; },
    args_sizes_get(n, size) { view().setUint32(n, 0, true); view().setUint32(size, 0, true); return SUCCESS; },
    args_get() { return SUCCESS; },
    environ_sizes_get(n, size) { view().setUint32(n, 0, true); view().setUint32(size, 0, true); return SUCCESS; },
    environ_get() { return SUCCESS; },
    clock_time_get(clock, precision, at) {
      const ms = clock === 0 ? Date.now() : performance.now();
      view().setBigUint64(at, BigInt(Math.round(ms * 1e6)), true);
      return SUCCESS;
    },
    clock_res_get(clock, at) { view().setBigUint64(at, 1000n, true); return SUCCESS; },
    random_get(at, n) { crypto.getRandomValues(bytes(at, n)); return SUCCESS; },
    sched_yield() { return SUCCESS; },

    fd_prestat_get(fd, at) {
      if (fd !== 3) return BADF;
      view().setUint32(at, 0, true);
      view().setUint32(at + 4, 1, true);
      return SUCCESS;
    },
    fd_prestat_dir_name(fd, at) { bytes(at, 1)[0] = 47; return SUCCESS; }, // "/"
    fd_fdstat_get(fd, at) {
      if (!open.has(fd)) return BADF;
      bytes(at, 24).fill(0);
      view().setUint8(at, fd < 3 ? CHARACTERS : fd === 3 ? DIRECTORY : REGULAR);
      view().setBigUint64(at + 8, ~0n & 0xffffffffffffffffn, true);
      view().setBigUint64(at + 16, ~0n & 0xffffffffffffffffn, true);
      return SUCCESS;
    },
    fd_fdstat_set_flags() { return SUCCESS; },
    fd_filestat_get(fd, at) {
      const file = open.get(fd);
      return file ? fileStat(at, fd < 3 ? CHARACTERS : fd === 3 ? DIRECTORY : REGULAR, file.size || 0) : BADF;
    },
    fd_close(fd) { return open.delete(fd) ? SUCCESS : BADF; },
    fd_sync() { return SUCCESS; },
    fd_datasync() { return SUCCESS; },
    fd_seek(fd, offset, whence, at) {
      const file = open.get(fd);
      if (!file || !file.data) return BADF;
      const to = Number(offset) + (whence === 0 ? 0 : whence === 1 ? file.at : file.size);
      if (to < 0) return INVAL;
      file.at = to;
      view().setBigUint64(at, BigInt(to), true);
      return SUCCESS;
    },
    fd_read(fd, iovs, n, at) {
      const file = open.get(fd);
      let total = 0;
      for (const [where, length] of file && file.data ? pieces(iovs, n) : []) {
        const piece = file.data.subarray(file.at, Math.min(file.at + length, file.size));
        bytes(where, piece.length).set(piece);
        file.at += piece.length;
        total += piece.length;
      }
      view().setUint32(at, total, true);
      return file ? SUCCESS : BADF;
    },
    fd_write(fd, iovs, n, at) {
      const file = open.get(fd);
      let total = 0;
      if (!file) return BADF;
      for (const [where, length] of pieces(iovs, n)) {
        if (fd < 3) said[fd] += text(where, length);
        else append(file, bytes(where, length).slice());
        total += length;
      }
      view().setUint32(at, total, true);
      return SUCCESS;
    },

    path_open(dir, dirflags, at, length, oflags, rights, inheriting, flags, fd) {
      const path = text(at, length), create = oflags & 1, exclusive = oflags & 4, truncate = oflags & 8;
      if (oflags & 2 || (!create && !exists(path))) return NOENT;
      if (exclusive && exists(path)) return EXIST;
      if (truncate || !exists(path)) {
        put(path, new Uint8Array(0));
        written.add(path);
      }
      const number = Math.max(...open.keys()) + 1, data = store.get(path);
      open.set(number, { path, data, size: data.length, at: 0 });
      view().setUint32(fd, number, true);
      return SUCCESS;
    },
    path_filestat_get(dir, flags, at, length, out) {
      const path = text(at, length);
      if (exists(path)) return fileStat(out, REGULAR, store.get(path).length);
      return isDirectory(path) ? fileStat(out, DIRECTORY, 0) : NOENT;
    },
    path_rename(dir, at, length, to, at2, length2) {
      const from = text(at, length), name = text(at2, length2);
      if (!exists(from)) return NOENT;
      put(name, store.get(from));
      store.delete(from);
      written.delete(from);
      written.add(name);
      return SUCCESS;
    },
    path_unlink_file(dir, at, length) {
      const path = text(at, length);
      written.delete(path);
      return store.delete(path) ? SUCCESS : NOENT;
    },
    path_create_directory() { return SUCCESS; },
    path_readlink() { return INVAL; }, // there are no links
  };
  const missing = { get: (known, name) => known[name] || (() => NOSYS) };
  const imports = {
    wasi_snapshot_preview1: new Proxy(wasi, missing),
    env: {
      web_show(rgba, pixels, width, height, iterations, seconds, rmse8, ratio) {
        const n = width * height;
        show({ picture: bytes(rgba, 4 * n).slice(), pixels: bytes(pixels, 12 * n).slice(), width, height, iterations,
               seconds, rmse8, ratio });
      },
      web_learns(share) { show({ learnt: share }); },
    },
  };

  const instance = new WebAssembly.Instance(new WebAssembly.Module(wasm), imports), c = instance.exports;
  memory = c.memory;
  let status;
  try {
    c._initialize();
    const line = new TextEncoder().encode(words.map(word => word + '\0').join(''));
    const at = c.web_words(line.length); // may move the memory
    bytes(at, line.length).set(line);
    status = c[call](words.length);
    if (call === 'web_begin' && status === 0) {
      await listen();
      for (let heard = Date.now(); c.web_step();)
        if (Date.now() - heard > 50) {
          await listen();
          heard = Date.now();
        }
    }
  } catch (e) {
    if (e.exit === undefined) said[2] += String(e);
    status = e.exit === undefined ? 1 : e.exit;
  }
  const made = Object.fromEntries([...written].filter(exists).map(path => [path, store.get(path)]));
  return { status, out: said[1], err: said[2], files: made };
}

if (typeof onmessage !== 'undefined')
  onmessage = async ({ data }) => data.held !== undefined ? hold(data.held)
    : postMessage(await run(data, state => postMessage(state)));
