// SPDX-License-Identifier: GPL-3.0-or-later
// What the report page must do in a browser, one function per check.
import { strict as assert } from 'node:assert';

const OPEN_LIMIT = 2000;        // ms until 1,000 poses can be read and sorted
const LARGE_OPEN_LIMIT = 15000;  // ms for 100,000, on a machine that may be busy with other tests

const cells = (page, column) => page.locator(`#table-scroll tr.row td:nth-child(${column})`).allTextContents();
const title = (page) => page.locator('#viewer-title').textContent();
const nothingWrong = ({ faults }) => assert.deepEqual(faults, []);

/** The header whose text starts so, and its column's number from 1. */
async function header(page, text) {
  const all = await page.locator('#table-scroll th').allTextContents();
  const index = all.findIndex((t) => t.replace(/^[\u25b2\u25bc]/, '').startsWith(text));
  assert.ok(index >= 0, `no column ${text} in ${all}`);
  return { column: index + 1, button: page.locator('#table-scroll th button').nth(index) };
}

/** Shares of the 3D view: pixels that are not its ground, and how many colours there are. */
async function view(page) {
  await page.evaluate(() => new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); }));
  const shot = await page.locator('#stage canvas').first().screenshot();
  return page.evaluate(async (png) => {
    const image = await createImageBitmap(new Blob([Uint8Array.from(atob(png), (c) => c.charCodeAt(0))], { type: 'image/png' }));
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    const colours = new Map();
    for (let i = 0; i < data.length; i += 4) {
      const key = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
      colours.set(key, (colours.get(key) ?? 0) + 1);
    }
    const ground = Math.max(...colours.values());
    return { drawn: 1 - (4 * ground) / data.length, colours: colours.size };
  }, shot.toString('base64'));
}

async function showsSomething(page) {
  const { drawn, colours } = await view(page);
  assert.ok(drawn > 0.05, `the 3D view is blank: ${drawn} of it drawn`);
  assert.ok(colours > 50, `the 3D view has ${colours} colours`);
  return drawn;
}

/** WCAG contrast of two colours of the theme. */
const contrasts = (page) => page.evaluate(() => {
  const context = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
  const luminance = (name) => {
    context.fillStyle = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`);
    context.fillRect(0, 0, 1, 1);
    const [r, g, b] = Array.from(context.getImageData(0, 0, 1, 1).data, (v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const pairs = [];
  for (const text of ['ink', 'ink-2', 'ink-3', 'fixed', 'moving', 'high', 'medium', 'acceptable', 'incorrect'])
    for (const ground of ['panel', 'sunken', ...(text.startsWith('ink') ? ['ground', 'row-selected', 'row-hover'] : [])]) {
      const [a, b] = [luminance(text), luminance(ground)].sort((x, y) => y - x);
      pairs.push([`${text} on ${ground}`, (a + 0.05) / (b + 0.05)]);
    }
  return pairs;
});

export const checks = {
  async 'molecules open fast, sort, select, step'(open) {
    // Three attempts: other tests may be running.
    let report = await open('molecules');
    for (let k = 0; k < 2 && report.opened >= OPEN_LIMIT; ++k) {
      await report.close();
      report = await open('molecules');
    }
    const { page, opened } = report;
    assert.ok(opened < OPEN_LIMIT, `1,000 poses opened in ${opened} ms`);
    assert.equal(await page.locator('#count').textContent(), '1,000 poses');
    assert.ok(await page.locator('#table-scroll tr.row').count() < 80, 'only the visible rows are made');
    assert.equal(await title(page), 'Pose 1');

    const dockq = await header(page, 'DockQ');
    await dockq.button.click();
    const best = (await cells(page, dockq.column)).map(Number);
    assert.deepEqual(best, [...best].sort((a, b) => b - a), 'best DockQ first');
    await dockq.button.click();
    const worst = (await cells(page, dockq.column)).map(Number);
    assert.deepEqual(worst, [...worst].sort((a, b) => a - b), 'then the worst');
    const rmsd = await header(page, 'i-RMSD');
    await rmsd.button.click();
    const low = (await cells(page, rmsd.column)).map(Number);
    assert.deepEqual(low, [...low].sort((a, b) => a - b), 'lowest i-RMSD first');
    await (await header(page, 'Rank')).button.click();

    await page.locator('#table-scroll tr.row').nth(3).click();
    assert.equal(await title(page), 'Pose 4');
    await page.keyboard.press('j');
    assert.equal(await title(page), 'Pose 5');
    await page.locator('#table-scroll').focus();
    await page.keyboard.press('ArrowUp');
    await page.keyboard.press('ArrowUp');
    assert.equal(await title(page), 'Pose 3');
    await page.keyboard.press('End');
    assert.equal(await title(page), 'Pose 1000');
    assert.ok((await cells(page, 1)).includes('1000'), 'the table scrolled to the chosen row');
    await page.keyboard.press('Home');
    await page.locator('#next').click();
    assert.equal(await title(page), 'Pose 2');
    assert.equal(await page.locator('tr.row[aria-current="true"] td').first().textContent(), '2');
    await page.locator('#previous').click();

    await page.locator('#filter').selectOption('acceptable');
    assert.match(await page.locator('#count').textContent(), /^\d+ of 1,000 poses$/);
    const classes = await cells(page, (await header(page, 'CAPRI')).column);
    assert.ok(classes.length > 0 && classes.every((text) => text !== 'incorrect'));
    await page.locator('#filter').selectOption('founders');
    const clusters = await cells(page, (await header(page, 'Cluster')).column);
    assert.equal(new Set(clusters).size, clusters.length, 'one pose of each cluster');
    assert.match(await page.locator('#clusters').textContent(), /^\d[\d,]* clusters/);
    await page.locator('#table-scroll tr.row').nth(0).click();
    const mine = (await cells(page, (await header(page, 'Cluster')).column))[0];
    await page.locator('#filter').selectOption('members');
    assert.deepEqual([...new Set(await cells(page, (await header(page, 'Cluster')).column))], [mine], 'only the chosen cluster');
    await page.locator('#filter').selectOption('all');
    nothingWrong(report);
    await report.close();
    return `table after ${opened} ms, everything after ${report.drawn} ms`;
  },

  async 'molecules in 3D: surface, colours, exploded, contacts'(open) {
    const report = await open('molecules');
    const { page } = report;
    await report.surface();
    const after = await showsSomething(page);
    await page.locator('#fixed-style').selectOption('cartoon');
    await page.waitForTimeout(400);
    const before = await showsSomething(page);
    await page.locator('#fixed-style').selectOption('surface');
    await page.waitForTimeout(400);
    await report.surface();
    assert.ok(after > before + 0.05, `the surface covers more: ${before} to ${after}`);
    await report.picture('molecules_light.png', { fullPage: true });
    const plain = await view(page);
    await page.locator('#colour').selectOption('density');
    await page.waitForTimeout(400);
    assert.notEqual((await view(page)).colours, plain.colours);
    await page.locator('#exploded').fill('60');
    await page.waitForTimeout(400);
    await report.picture('molecules_exploded.png');
    const contacts = await page.locator('canvas[aria-label^="Contact map of pose 1:"]').getAttribute('aria-label');
    assert.ok(Number(contacts.match(/: (\d+)/)[1]) > 20, contacts);
    nothingWrong(report);
    await report.close();
  },

  async 'plots choose poses'(open) {
    const report = await open('molecules');
    const { page } = report;
    const funnel = page.locator('canvas[aria-label^="Scatter plot"]');
    await funnel.scrollIntoViewIfNeeded();
    const box = await funnel.boundingBox();
    const before = await title(page);
    await page.mouse.move(box.x + box.width * 0.7, box.y + box.height * 0.6);
    await page.locator('#tip', { hasText: 'rank' }).waitFor({ timeout: 5000 });
    await page.mouse.click(box.x + box.width * 0.7, box.y + box.height * 0.6);
    assert.notEqual(await title(page), before, 'a click on the funnel chooses a pose');
    nothingWrong(report);
    await report.close();
  },

  async 'dark theme: by the system and by the button'(open) {
    const report = await open('molecules', { scheme: 'dark' });
    const { page } = report;
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
    await report.surface();
    await showsSomething(page);
    await report.picture('molecules_dark.png', { fullPage: true });
    for (const [pair, ratio] of await contrasts(page)) assert.ok(ratio >= 4.5, `dark: ${pair} has contrast ${ratio.toFixed(2)}`);
    await page.locator('#theme').click();
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'light');
    for (const [pair, ratio] of await contrasts(page)) assert.ok(ratio >= 4.5, `light: ${pair} has contrast ${ratio.toFixed(2)}`);
    nothingWrong(report);
    await report.close();
  },

  async 'narrow as a phone'(open) {
    const report = await open('molecules', { width: 390, height: 844 });
    const { page } = report;
    const overflow = await page.evaluate(() => document.scrollingElement.scrollWidth - innerWidth);
    assert.ok(overflow <= 0, `${overflow} pixels too wide`);
    await report.surface();
    await showsSomething(page);
    await report.picture('molecules_narrow.png', { fullPage: true });
    await page.locator('#table-scroll tr.row').nth(2).click();
    assert.equal(await title(page), 'Pose 3');
    nothingWrong(report);
    await report.close();
  },

  async 'every control has a name'(open) {
    const report = await open('molecules');
    const unnamed = await report.page.evaluate(() => [...document.querySelectorAll('button, select, input, canvas')]
      .filter((e) => !(e.getAttribute('aria-label') || e.textContent.trim() || e.labels?.length)).map((e) => e.outerHTML.slice(0, 90)));
    assert.deepEqual(unnamed, []);
    const ids = await report.page.evaluate(() => [...document.querySelectorAll('[id]')].map((e) => e.id));
    assert.equal(new Set(ids).size, ids.length, 'ids are unique');
    await report.close();
  },

  async 'parts: see-through and exploded'(open) {
    const report = await open('parts');
    const { page } = report;
    await showsSomething(page);
    await report.picture('parts_light.png', { fullPage: true });
    const at = await view(page);
    await page.locator('#see-through').fill('0');
    await page.waitForTimeout(300);
    const solid = await view(page);
    assert.notDeepEqual(solid, at, 'see-through changes the picture');
    await page.locator('#exploded').fill('50');
    await page.waitForTimeout(300);
    assert.notDeepEqual(await view(page), solid, 'so does exploding');
    await page.locator('#home').click();
    await report.picture('parts_exploded.png');
    await page.locator('#exploded').fill('0');
    const map = page.locator('canvas[aria-label^="Faces in contact in pose 1:"]');
    assert.ok(Number((await map.getAttribute('aria-label')).match(/: (\d+)/)[1]) > 0, 'the pin touches the plate');
    await map.scrollIntoViewIfNeeded();
    await page.locator('#colour').selectOption('contact');
    await page.waitForTimeout(300);
    assert.match(await page.locator('.legend').textContent(), /in contact/);
    const box = await map.boundingBox();
    let spot = null;  // a cell with a pair
    for (let k = 0; k < 64 && !spot; ++k) {
      const [x, y] = [box.x + box.width * (0.25 + 0.1 * (k % 8)), box.y + box.height * (0.05 + 0.09 * Math.floor(k / 8))];
      await page.mouse.move(x, y);
      if (/in contact/.test(await page.locator('#tip').textContent()) && await page.locator('#tip').isVisible()) spot = [x, y];
    }
    assert.ok(spot, 'a tip names the faces');
    await page.mouse.click(...spot);
    assert.match(await page.locator('.legend').textContent(), / on /, 'a click shows one pair of faces');
    await page.locator('#viewer').scrollIntoViewIfNeeded();
    await report.picture('parts_contact.png');
    nothingWrong(report);
    await report.close();
  },

  async 'one pose, no reference, no poses, unfinished'(open) {
    for (const name of ['one', 'no_reference', 'unfinished']) {
      const report = await open(name);
      await report.surface();
      await showsSomething(report.page);
      nothingWrong(report);
      if (name === 'one') assert.equal(await report.page.locator('#count').textContent(), '1 pose');
      if (name === 'unfinished') assert.match(await report.page.locator('#notices').textContent(), /49 of 50 rotations.*--resume/s);
      if (name === 'no_reference') assert.match(await report.page.locator('#notices').textContent(), /made by Mortise 0\.0\.9/);
      await report.picture(`${name}.png`, { fullPage: true });
      await report.close();
    }
    const report = await open('zero');
    await showsSomething(report.page);
    assert.match(await report.page.locator('#table-scroll').textContent(), /no poses/);
    nothingWrong(report);
    await report.picture('zero.png');
    await report.close();
  },

  async 'without structures: numbers and plots'(open) {
    const report = await open('missing');
    const { page } = report;
    assert.match(await page.locator('#notices').textContent(), /the run's moving input is not there/);
    assert.match(await page.locator('#stage-message').textContent(), /Without structures/);
    assert.equal(await page.locator('#count').textContent(), '30 poses');
    assert.ok(await page.locator('#plots canvas').count() >= 3);
    await page.keyboard.press('j');
    assert.equal(await title(page), 'Pose 2');
    nothingWrong(report);
    await report.picture('missing.png', { fullPage: true });
    await report.close();
  },

  async 'a large part is simplified and says so'(open) {
    const report = await open('large');
    await showsSomething(report.page);
    assert.match(await report.page.locator('#details').textContent(), /lies within/);
    nothingWrong(report);
    await report.close();
    return `table after ${report.opened} ms, everything after ${report.drawn} ms`;
  },

  async 'names from files stay text'(open) {
    const report = await open('hostile');
    const { page } = report;
    await report.surface();
    assert.equal(await page.evaluate(() => globalThis.broken), undefined);
    assert.equal(await page.locator('img').count(), 0);
    assert.match(await page.locator('#notices').textContent(), /<\/script><img src=x/);
    assert.match(await page.locator('#details').textContent(), /<\/script><img src=x/);
    nothingWrong(report);
    await report.close();
  },

  async 'unusual residues, two-letter chains, large numbers'(open) {
    const report = await open('unusual');
    await report.surface();
    await showsSomething(report.page);
    assert.ok(await report.page.evaluate(() => globalThis.mortise.viewer.fixed.names.length) === 99, 'no residue is lost');
    nothingWrong(report);
    await report.picture('unusual.png');
    await report.close();
  },

  async '100,000 poses stay usable'(open) {
    const report = await open('many');
    const { page } = report;
    assert.ok(report.opened < LARGE_OPEN_LIMIT, `opened in ${report.opened} ms`);
    assert.equal(await page.locator('#count').textContent(), '100,000 poses');
    const start = Date.now();
    await (await header(page, 'Contact')).button.click();
    const sorted = Date.now() - start;
    const contact = await header(page, 'Contact');
    assert.deepEqual(await page.locator('#table-scroll th').nth(contact.column - 1).getAttribute('aria-sort'), 'ascending');
    await (await header(page, 'Rank')).button.click();
    await page.locator('#table-scroll').focus();
    await page.keyboard.press('End');
    assert.equal(await title(page), 'Pose 100000');
    assert.ok((await cells(page, 1)).includes('100000'));
    nothingWrong(report);
    await report.picture('many.png');
    await report.close();
    return `table after ${report.opened} ms, sorted in ${sorted} ms`;
  },
};
