// The bundle from its sources:  node build.mjs NODE_MODULES [FILE]  (npm ci puts uplot and esbuild there)
import { createRequire } from 'node:module';
import { dirname, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { readFileSync, writeFileSync } from 'node:fs';

const here = dirname(fileURLToPath(import.meta.url)), modules = resolve(process.argv[2]);
const esbuild = createRequire(modules + '/')('esbuild');
// kinds of curves and dates that no plot here has: what uPlot offers of them goes, and then nothing uses their functions
const unused = /^\t\(paths\.(stepped|bars|spline) *= .*\n|^\tuPlot\.(fmtDate|tzDate|join) *= .*\n/gm;
const withoutUnused = {
  name: 'without unused',
  setup: build => build.onLoad({ filter: /uPlot\.esm\.js$/ }, args => {
    const text = readFileSync(args.path, 'utf8');
    if (text.match(unused)?.length !== 6) throw new Error('uPlot offers other things than this was made for');
    return { contents: text.replace(unused, ''), loader: 'js' };
  }),
};
const out = await esbuild.build({
  absWorkingDir: here, entryPoints: ['page.js'], bundle: true, minify: true, write: false, format: 'iife', target: 'es2022', charset: 'utf8',
  legalComments: 'inline', nodePaths: [modules], plugins: [withoutUnused],
});
// within an element of a page: nothing may look like its end
const text = out.outputFiles[0].text.replace(/<\/script/gi, '<\\/script').replace(/<!--/g, '<\\!--');
writeFileSync(process.argv[3] ?? here + '/page.min.js', text);
console.log(`${Buffer.byteLength(text)} bytes`);
