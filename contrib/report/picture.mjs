// A picture of a page:  node picture.mjs NODE_MODULES PAGE.html PICTURE.png [what is done before, JavaScript with `page`]
import { createRequire } from 'node:module';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [, , modules, file, picture, action] = process.argv;
const { chromium } = createRequire(resolve(modules) + '/')('playwright-core');
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
const tab = await (await browser.newContext({ viewport: { width: 1400, height: 800 }, colorScheme: 'light', reducedMotion: 'reduce' })).newPage();
tab.setDefaultTimeout(120000); // drawing by software
await tab.goto(pathToFileURL(resolve(file)).href);
await tab.waitForFunction(() => window.page?.ready, null, { polling: 100 });
if (action) await tab.evaluate(action);
await tab.waitForTimeout(500);
await tab.screenshot({ path: picture });
await browser.close();
