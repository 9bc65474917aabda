// Runs a page in headless Chromium and prints what it found: node run_page.mjs FOLDER PAGE.html [NAME=FOLDER ...]
// FOLDER is served at /, each NAME=FOLDER at /NAME/, and the installed npm packages at /modules/. The page sets
// `window.result` to what is printed as JSON (or to a promise of it). An error on the page is exit code 1.
// `--screenshot=FILE.png` writes a picture of the window then; `--file` opens the page from disk, without a server, and
// `--ready=EXPRESSION` waits for that to be true, `--result=EXPRESSION` then asks for something else than window.result; `--modules=FOLDER` serves other npm packages.
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { dirname, extname, join, normalize, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.json': 'application/json',
                '.wgsl': 'text/plain', '.glsl': 'text/plain', '.wasm': 'application/wasm' };
// Without a GPU: WebGL2 and WebGPU by the software rasteriser.
const FLAGS = ['--enable-unsafe-swiftshader', '--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader', '--use-angle=swiftshader'];
const PATIENCE_MS = 90000;

function fileOf(mounts, path) {
  const name = Object.keys(mounts).filter((prefix) => path.startsWith(prefix)).sort((a, b) => b.length - a.length)[0];
  return join(mounts[name], normalize('/' + path.slice(name.length)));
}

async function serve(mounts) {
  const server = createServer(async (request, response) => {
    const path = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
    try {
      const body = await readFile(fileOf(mounts, path));
      response.writeHead(200, { 'content-type': TYPES[extname(path)] ?? 'application/octet-stream' }).end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  return server;
}

async function run(folder, pageName, named, options) {
  const here = dirname(fileURLToPath(import.meta.url));
  const ready = options.ready ?? 'window.result !== undefined';
  const mounts = { '/': folder, '/modules/': options.modules ?? join(here, 'node_modules') };
  for (const each of named) mounts[`/${each.slice(0, each.indexOf('='))}/`] = each.slice(each.indexOf('=') + 1);
  const server = await serve(mounts);
  const browser = await chromium.launch({ executablePath: process.env.CUTICLE_CHROMIUM ?? '/usr/bin/chromium', args: FLAGS });
  try {
    const page = await browser.newPage({ viewport: { width: 1000, height: 800 } });
    const failed = new Promise((_, reject) => page.on('pageerror', reject));
    page.on('console', (message) => console.error(`page: ${message.text()}`));
    await page.goto(options.file ? `file://${resolve(folder)}/${pageName}` : `http://localhost:${server.address().port}/${pageName}`);
    const found = page.waitForFunction(ready, null, { timeout: PATIENCE_MS })
      .then(() => page.evaluate(options.result ?? 'window.result'));
    const result = await Promise.race([found, failed]);
    if (options.screenshot) await page.screenshot({ path: options.screenshot });
    return result;
  } finally {
    await browser.close();
    server.close();
  }
}

const [folder, pageName, ...rest] = process.argv.slice(2);
const options = Object.fromEntries(rest.filter((each) => each.startsWith('--')).map((each) => {
  const [, name, value] = each.match(/^--(\w+)=?(.*)$/s);
  return [name, value || true];
}));
console.log(JSON.stringify(await run(folder, pageName, rest.filter((each) => !each.startsWith('--')), options)));
