// The bundle from its sources:  node build.mjs NODE_MODULES [FILE]  (npm ci puts uplot and esbuild there)
import { createRequire } from 'node:module';
import { dirname, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { writeFileSync } from 'node:fs';

const here = dirname(fileURLToPath(import.meta.url)), modules = resolve(process.argv[2]);
const esbuild = createRequire(modules + '/')('esbuild');
const out = await esbuild.build({
  absWorkingDir: here, entryPoints: ['page.js'], bundle: true, minify: true, write: false, format: 'iife', target: 'es2022', charset: 'utf8',
  legalComments: 'inline', nodePaths: [modules],
});
// within an element of a page: nothing may look like its end
const text = out.outputFiles[0].text.replace(/<\/script/gi, '<\\/script').replace(/<!--/g, '<\\!--');
writeFileSync(process.argv[3] ?? here + '/page.min.js', text);
console.log(`${Buffer.byteLength(text)} bytes`);
