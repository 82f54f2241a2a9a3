// wasi.mjs: run a WASI program under node, with the files below this directory and /tmp:
// node --no-warnings test/run/wasi.mjs PROGRAM.wasm ...
import { readFileSync } from 'node:fs';
import { WASI } from 'node:wasi';

const args = process.argv.slice(2);
const wasi = new WASI({ version: 'preview1', args, preopens: { '.': '.', '/tmp': '/tmp' }, returnOnExit: true });
const imports = wasi.getImportObject();
const calls = imports.wasi_snapshot_preview1;
for (const [name, call] of Object.entries(calls)) // called by WebAssembly itself they harm node 20, which then crashes
  calls[name] = (...words) => call(...words);
const { instance } = await WebAssembly.instantiate(readFileSync(args[0]), imports);
process.exitCode = wasi.start(instance);
