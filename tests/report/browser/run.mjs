// SPDX-License-Identifier: GPL-3.0-or-later
// Opens the sample reports in Debian's chromium and uses them: run.mjs PAGES_DIR MANY_DIR SCREENSHOTS_DIR WORK_DIR
// [PART_OF_A_CHECKS_NAME].
//
// Exits with 77, which CTest counts as skipped, where chromium is not installed or npm cannot get playwright-core.
import { mkdirSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { launch } from './browser.mjs';
import { checks } from './checks.mjs';

const [pages, many, screenshots, work] = process.argv.slice(2, 6).map((path) => resolve(path));
const chosen = Object.entries(checks).filter(([name]) => name.includes(process.argv[6] ?? ''));
const browser = await launch(work, (why) => {
  console.log(`skipped: ${why}`);
  process.exit(77);
});
mkdirSync(screenshots, { recursive: true });

/**
 * A report in a page of its own; everything it should not do is collected in `faults`. The window is no larger than the
 * layout for wide windows asks for: pixels are what drawing by software costs.
 */
async function open(name, { scheme = 'light', width = 1200, height = 600 } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: scheme, reducedMotion: 'reduce' });
  const page = await context.newPage();
  page.setDefaultTimeout(120_000);  // other tests may keep the machine busy
  const faults = [];
  page.on('console', (message) => faults.push(`console ${message.type()}: ${message.text()}`));
  page.on('pageerror', (error) => faults.push(`error: ${error.message}`));
  page.on('request', (request) => {
    if (!/^(file|blob|data):/.test(request.url())) faults.push(`request: ${request.url()}`);
  });
  const start = Date.now();
  await page.goto(`file://${join(name === 'many' ? many : pages, name, 'index.html')}`);
  await page.waitForFunction(() => document.documentElement.dataset.ready, null, { timeout: 60_000 });
  const opened = Date.now() - start;
  await page.waitForFunction(() => document.documentElement.dataset.ready === 'all', null, { timeout: 60_000 });
  const drawn = Date.now() - start;
  return {
    page, faults, opened, drawn,
    surface: () => page.waitForFunction(() => !globalThis.mortise.viewer || globalThis.mortise.viewer.surfaceReady(), null, { timeout: 120_000 }),
    picture: (file, options = {}) => page.screenshot({ path: join(screenshots, file), ...options }),
    close: () => context.close(),
  };
}

let failed = 0;
for (const [name, check] of chosen) {
  const start = Date.now();
  try {
    const said = await check(open);
    console.log(`ok      ${name} (${Date.now() - start} ms)${said ? `: ${said}` : ''}`);
  } catch (error) {
    ++failed;
    console.log(`FAILED  ${name}: ${error.stack}`);
  }
}
await browser.close();
console.log(`${chosen.length - failed} of ${chosen.length} checks passed; screenshots are in ${screenshots}`);
process.exit(failed ? 1 : 0);
