// Runs a program of WebAssembly as one of this machine: its files, its standard input, its exit code.
//
// run_wasm.mjs PROGRAM ARGUMENTS...
import { readFile } from 'node:fs/promises'
import { WASI } from 'node:wasi'

const [program, ...words] = process.argv.slice(2)
const wasi = new WASI({ version: 'preview1', args: [program, ...words], preopens: { '/': '/' }, returnOnExit: true })
const { instance } = await WebAssembly.instantiate(await readFile(program), { wasi_snapshot_preview1: wasi.wasiImport })
process.exitCode = wasi.start(instance)
