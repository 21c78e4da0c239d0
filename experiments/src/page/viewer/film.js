// Films: what the tetrahedra are after so many events, of the data that the page has. No geometry, no drawing.

/** A scene of the page's data with what follows from it: for each run the clock and the counts after each number of events. */
function openScene(data) {
  const crosses = data.tets.map((tet) => {
    const sides = tet.map((v) => data.sides[v]);
    return sides.includes(1) && sides.includes(-1);
  });
  // Tetrahedra with no vertex below are above; those that cross are neither.
  const above = data.tets.map((tet) => tet.some((v) => data.sides[v] === 1));
  const runs = data.runs.map((run) => openRun(data, run, crosses));
  const scene = { ...data, crosses, above, runs, at: data.positions };
  scene.positions = { time: mergedByTime(runs), count: abreast(runs) };
  return scene;
}

function openRun(data, run, crosses) {
  let clock = -Infinity;
  let crossing = data.before.filter((t) => crosses[t]).length;
  let [size, flips, listed, latest] = [data.before.length, 0, 0, 0];
  const after = [{ clock: null, crossing, size, flips, listed }];
  const steps = run.steps.map((step) => {
    const time = run.times === "exact" ? step.exact : (step.rounded?.[0] ?? null);
    // A rounded queue can hand out an event that is earlier than the one before; its clock does not go back.
    if (time !== null && step.fate !== "dropped" && step.fate !== "from-list") clock = Math.max(clock, time);
    crossing += step.created.filter((t) => crosses[t]).length - step.removed.filter((t) => crosses[t]).length;
    size += step.created.length - step.removed.length;
    if (step.flip > 0) flips += 1;
    if (step.fate === "postponed") listed += 1;
    if (step.fate === "from-list" || step.fate === "dropped") listed -= 1;
    const late = step.rank !== null && step.rank < latest;
    if (step.rank !== null) latest = Math.max(latest, step.rank);
    after.push({ clock: clock === -Infinity ? null : clock, crossing, size, flips, listed });
    return { ...step, time, late };
  });
  const ranks = steps.filter((step) => step.rank !== null).length;
  return { ...run, steps, after, ranks };
}

/** The tetrahedra of a run after k events, ascending. */
function tetsAfter(scene, run, k) {
  const now = new Set(scene.before);
  for (const step of run.steps.slice(0, k)) {
    step.removed.forEach((t) => now.delete(t));
    step.created.forEach((t) => now.add(t));
  }
  return [...now].sort((a, b) => a - b);
}

/** How many events each run has had, one event after the other in the order of their clocks. */
function mergedByTime([a, b]) {
  const positions = [[0, 0]];
  let [i, j] = [0, 0];
  while (i < a.steps.length || j < b.steps.length) {
    const [s, t] = [a.after[i + 1]?.clock ?? -Infinity, b.after[j + 1]?.clock ?? -Infinity];
    // Of equal clocks the run that is behind goes first.
    const first = j >= b.steps.length || (i < a.steps.length && (s < t || (s === t && i <= j)));
    if (first) i += 1;
    else j += 1;
    positions.push([i, j]);
  }
  return positions;
}

/** The same, each run at its own pace. */
function abreast([a, b]) {
  const [n, m] = [a.steps.length, b.steps.length];
  return Array.from({ length: Math.max(n, m) + 1 }, (_, k) => [Math.min(k, n), Math.min(k, m)]);
}

/** How many doubles y is after x. */
function ulpsBetween(x, y) {
  const bits = (value) => {
    const view = new DataView(new ArrayBuffer(8));
    view.setFloat64(0, value);
    const raw = view.getBigInt64(0);
    return raw < 0n ? -(raw & 0x7fffffffffffffffn) : raw;
  };
  return bits(y) - bits(x);
}
