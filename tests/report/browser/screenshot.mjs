// SPDX-License-Identifier: GPL-3.0-or-later
// Takes a picture of a report once all of it is drawn: screenshot.mjs REPORT/index.html PICTURE.png WORK_DIR.
import { resolve } from 'node:path';
import { launch } from './browser.mjs';

const [page, picture, work] = process.argv.slice(2).map((path) => resolve(path));
const browser = await launch(work, (why) => {
  throw new Error(why);
});
const tab = await (await browser.newContext({ viewport: { width: 1240, height: 780 } })).newPage();
tab.setDefaultTimeout(120_000);
await tab.goto(`file://${page}`);
await tab.waitForFunction(() => globalThis.mortise?.viewer?.surfaceReady());
await tab.waitForTimeout(1500);
await tab.screenshot({ path: picture });
await browser.close();
