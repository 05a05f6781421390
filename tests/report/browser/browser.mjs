// SPDX-License-Identifier: GPL-3.0-or-later
// Debian's chromium, driven by playwright-core, which npm installs once below a work folder.
import { execFileSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, readFileSync, renameSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));

function playwright(work, fail) {
  const { version } = JSON.parse(readFileSync(join(here, 'package-lock.json'), 'utf8')).packages['node_modules/playwright-core'];
  const installed = join(work, 'browser-packages', version);
  if (!existsSync(installed)) {
    const fresh = `${installed}.${process.pid}`;
    mkdirSync(fresh, { recursive: true });
    for (const name of ['package.json', 'package-lock.json', '.npmrc']) cpSync(join(here, name), join(fresh, name));
    try {
      execFileSync('npm', ['ci', '--ignore-scripts', '--prefer-offline', '--loglevel=error'], { cwd: fresh, stdio: 'inherit' });
    } catch (error) {
      rmSync(fresh, { recursive: true, force: true });
      fail(`npm did not get playwright-core (${error.message})`);
    }
    renameSync(fresh, installed);
  }
  return createRequire(join(installed, 'package.json'))('playwright-core');
}

/** Starts the browser, with WebGL by software; calls fail(why) where it cannot. */
export async function launch(work, fail) {
  const executablePath = ['/usr/bin/chromium', '/usr/bin/chromium-browser'].find((path) => existsSync(path));
  if (!executablePath) fail('there is no /usr/bin/chromium (Debian package chromium)');
  return playwright(work, fail).chromium.launch({
    executablePath,
    args: ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', '--no-sandbox'],
  });
}
