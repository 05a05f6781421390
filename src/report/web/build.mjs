// SPDX-License-Identifier: GPL-3.0-or-later
// Bundles the page: node build.mjs OUTPUT WORK_DIR writes one HTML file with style, viewer and code inside.
//
// WORK_DIR keeps the npm packages and the finished page under the hash of everything they are made from, so that a
// second build of the same sources, of whatever preset, needs neither npm nor the network.
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { cpSync, existsSync, mkdirSync, readFileSync, readdirSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const [output, workDir] = process.argv.slice(2).map((path) => resolve(path));

const hash = (...texts) => texts.reduce((sum, text) => sum.update(text), createHash('sha256'));
const read = (...path) => readFileSync(join(here, ...path), 'utf8');
const packageFiles = ['package.json', 'package-lock.json', '.npmrc'];
const sources = readdirSync(join(here, 'page')).sort();

/** The folder with the packages of the lock file, installed by npm if it is not there yet. */
function packages() {
  const folder = join(workDir, `packages-${hash(...packageFiles.map((name) => read(name))).digest('hex').slice(0, 16)}`);
  if (existsSync(folder)) return folder;
  const fresh = `${folder}.${process.pid}`;
  mkdirSync(fresh, { recursive: true });
  for (const name of packageFiles) cpSync(join(here, name), join(fresh, name));
  try {
    execFileSync('npm', ['ci', '--ignore-scripts', '--prefer-offline', '--loglevel=error'], { cwd: fresh, stdio: 'inherit' });
  } catch (error) {
    rmSync(fresh, { recursive: true, force: true });
    throw new Error(`npm ci failed (${error.message}). Without network, configure with -DMORTISE_REPORT=OFF.`);
  }
  try {
    renameSync(fresh, folder);
  } catch {
    rmSync(fresh, { recursive: true, force: true });  // another build was faster
  }
  return folder;
}

/** Text that can stand between script tags: the end tag and comment starts inside strings are broken up. */
const inScript = (text) => text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');

async function page() {
  const folder = packages();
  const { build } = createRequire(join(folder, 'package.json'))('esbuild');
  const bundle = async (entry, extra = {}) => {
    const result = await build({
      entryPoints: [join(here, 'page', entry)], bundle: true, minify: true, write: false, legalComments: 'none',
      charset: 'utf8', target: ['es2022'], logLevel: 'warning', ...extra,
    });
    return result.outputFiles[0].text.trim();
  };
  const viewer = inScript(readFileSync(join(folder, 'node_modules/3dmol/build/3Dmol-min.js'), 'utf8'));
  const code = inScript(await bundle('main.js', { format: 'iife' }));
  const style = await bundle('style.css');
  const sums = [viewer, code].map((text) => `'sha256-${hash(text).digest('base64')}'`).join(' ');
  const notices = readFileSync(join(folder, 'node_modules/3dmol/LICENSE'), 'utf8').replaceAll('--', '- -');
  // Functions as replacements: texts may hold "$&".
  return read('page', 'page.html')
    .replace('@script-hashes@', () => sums)
    .replace('@style@', () => style)
    .replace('@notices@', () => notices)
    .replace('@viewer@', () => viewer)
    .replace('@code@', () => code);
}

const key = hash(read('build.mjs'), ...packageFiles.map((name) => read(name)),
  ...sources.flatMap((name) => [name, read('page', name)])).digest('hex').slice(0, 16);
const cached = join(workDir, `page-${key}.html`);
if (!existsSync(cached)) {
  mkdirSync(workDir, { recursive: true });
  const text = await page();
  writeFileSync(`${cached}.${process.pid}`, text);
  renameSync(`${cached}.${process.pid}`, cached);
}
mkdirSync(dirname(output), { recursive: true });
cpSync(cached, output);
