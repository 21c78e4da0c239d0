// The viewer: its state, what its controls do to it, and bringing pictures and words up to date.

/** A factor, as people write it. */
function power(factor) {
  const [digits, exponent] = factor.toExponential().split("e+");
  return factor < 1e4 ? String(factor) : `${digits} · 10<sup>${exponent}</sup>`;
}

/** From where to look at a scene first: at the polygon neither edge-on nor from straight above, where the vertices are spread most. */
function goodView(scene) {
  const [a, b, c] = scene.polygon.map((v) => scene.at[v]);
  const [u, w] = [minus(b, a), minus(c, a)];
  const normal = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
  const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  const length = Math.hypot(...normal) || 1;
  const spread = (along) => {
    const places = scene.at.map((p) => dot(p, along));
    return Math.max(...places) - Math.min(...places);
  };
  const size = Math.max(...[0, 1, 2].map((i) => spread([0, 1, 2].map((j) => Number(i === j))))) || 1;
  let best = { score: -1 };
  for (const phi of [0.3, 0.45, 0.6, 0.75]) {
    for (let i = 0; i < 24; i += 1) {
      const theta = 0.13 + (i * Math.PI) / 12;
      const towards = [Math.cos(phi) * Math.sin(theta), Math.sin(phi), Math.cos(phi) * Math.cos(theta)];
      const right = [Math.cos(theta), 0, -Math.sin(theta)];
      const up = [-Math.sin(phi) * Math.sin(theta), Math.cos(phi), -Math.sin(phi) * Math.cos(theta)];
      const slant = Math.abs(dot(towards, normal)) / length;
      const score = 2 * Math.min(slant, 0.5) - Math.max(0, slant - 0.75) + (spread(right) * spread(up)) / size ** 2;
      if (score > best.score) best = { score, theta, phi };
    }
  }
  return { theta: best.theta, phi: best.phi, distance: 4.1 };
}

function startViewer() {
  const $ = (id) => document.getElementById(`v-${id}`);
  const root = document.getElementById("v");
  root.hidden = false;
  const scenes = JSON.parse(document.getElementById("scenes").textContent).map(openScene);
  const panels = [...root.querySelectorAll(".panel")];
  const tellers = [...root.querySelectorAll(".teller")];
  const stages = panels.map((panel) => new Stage(panel.querySelector("canvas"), panel.querySelector(".labels")));
  const works = stages.every((stage) => stage.works);
  if (!works) {
    panels.forEach((panel) => {
      panel.querySelector(".stage").innerHTML = "<p class=\"missing\">This browser has no WebGL 2: there are no pictures, but all steps can be read below.</p>";
    });
  }
  const view = { theta: 0.55, phi: 0.48, distance: 4.1, shrink: 0.78, explode: 0 };
  const state = { scene: scenes[0], mode: "time", position: 0, timer: null };

  const steps = () => state.scene.positions[state.mode];
  const scheduled = { drawing: false };

  /** Draws both pictures, once a frame at most. */
  function draw() {
    if (scheduled.drawing) return;
    scheduled.drawing = true;
    requestAnimationFrame(() => {
      scheduled.drawing = false;
      stages.forEach((stage) => stage.render(view));
    });
  }

  /** Brings everything up to date with the state. */
  function update() {
    const [scene, position] = [state.scene, steps()[state.position]];
    scene.runs.forEach((run, i) => {
      const k = position[i];
      stages[i].show(scene, run, k, { settled: $("settled").checked, polygon: $("polygon").checked });
      const [status, event, ranks] = ["status", "event", "ranks"].map((name) => tellers[i].querySelector(`.${name}`));
      status.innerHTML = tellStatus(run, k);
      event.innerHTML = tellEvent(scene, run, k);
      ranks.innerHTML = rankPlot(run, k);
      tellers[i].querySelectorAll(".events button").forEach((button, j) => {
        if (j === k - 1) button.setAttribute("aria-current", "step");
        else button.removeAttribute("aria-current");
      });
      if (works) panels[i].querySelector("canvas").setAttribute("aria-label", `Tetrahedra: ${status.textContent}`);
    });
    const slider = $("slider");
    slider.max = steps().length - 1;
    slider.value = state.position;
    const clock = scene.runs.map((run, i) => run.after[position[i]].clock).filter((t) => t !== null);
    const now = clock.length > 0 ? `τ = ${Math.max(...clock)}` : "τ = 0";
    $("clock").innerHTML = `step ${state.position} of ${steps().length - 1}<br>${state.mode === "time" ? now : "&nbsp;"}`;
    slider.setAttribute("aria-valuetext", `step ${state.position}, ${now}`);
    draw();
  }

  function go(position) {
    state.position = Math.max(0, Math.min(steps().length - 1, position));
    update();
  }

  /** To the first position at which run i has had k events. */
  function goTo(i, k) {
    pause();
    go(steps().findIndex((position) => position[i] >= k));
  }

  function choose(scene) {
    pause();
    state.scene = scene;
    stages.forEach((stage) => stage.frame(scene));
    Object.assign(view, goodView(scene));
    const large = scene.exaggeration > 1 ? ` Heights are drawn ${power(scene.exaggeration)} times too large.` : "";
    $("text").innerHTML = `${scene.text}${large} <small>(<code>${scene.name}</code>: ${scene.vertices} vertices, ${scene.before.length} crossing tetrahedra)</small>`;
    scene.runs.forEach((run, i) => { tellers[i].querySelector(".events").innerHTML = listEvents(scene, run); });
    go(0);
  }

  function pause() {
    clearInterval(state.timer);
    state.timer = null;
    $("play").classList.remove("on");
    $("play").setAttribute("aria-label", "Play");
  }

  function play() {
    if (state.position === steps().length - 1) go(0);
    $("play").classList.add("on");
    $("play").setAttribute("aria-label", "Pause");
    state.timer = setInterval(() => {
      go(state.position + 1);
      if (state.position === steps().length - 1) pause();
    }, Number($("speed").value));
  }

  const toggle = () => (state.timer === null ? play() : pause());
  const by = (n) => { pause(); go(state.position + n); };
  const turn = (dx, dy) => {
    view.theta -= dx;
    view.phi = Math.max(-1.55, Math.min(1.55, view.phi + dy));
    draw();
  };
  const zoom = (factor) => {
    view.distance = Math.max(1, Math.min(16, view.distance * factor));
    draw();
  };

  $("scene").innerHTML = scenes.map((scene, i) => `<option value="${i}">${scene.title}</option>`).join("");
  $("scene").addEventListener("change", () => choose(scenes[$("scene").value]));
  root.querySelectorAll("input[name=v-mode]").forEach((radio) => radio.addEventListener("change", () => {
    const at = steps()[state.position];
    state.mode = radio.value;
    // Where the exact order has had as many events.
    go(steps().findIndex((position) => position[0] >= at[0]));
  }));
  $("first").addEventListener("click", () => by(-Infinity));
  $("back").addEventListener("click", () => by(-1));
  $("on").addEventListener("click", () => by(1));
  $("last").addEventListener("click", () => by(Infinity));
  $("play").addEventListener("click", toggle);
  $("slider").addEventListener("input", () => { pause(); go(Number($("slider").value)); });
  $("speed").addEventListener("change", () => { if (state.timer !== null) { pause(); play(); } });
  for (const name of ["shrink", "explode"]) {
    $(name).addEventListener("input", () => { view[name] = Number($(name).value); draw(); });
  }
  for (const name of ["settled", "polygon"]) $(name).addEventListener("change", update);
  $("near").addEventListener("click", () => zoom(0.8));
  $("far").addEventListener("click", () => zoom(1.25));
  $("reset").addEventListener("click", () => { Object.assign(view, goodView(state.scene)); draw(); });
  tellers.forEach((teller, i) => teller.addEventListener("click", (event) => {
    const step = event.target.closest("[data-step]");
    if (step !== null) goTo(i, Number(step.dataset.step));
  }));

  root.addEventListener("keydown", (event) => {
    const field = event.target.closest("select, input[type=radio], #v-shrink, #v-explode") !== null;
    if (field || event.ctrlKey || event.altKey || event.metaKey) return;
    const press = event.target.closest("button, summary, input[type=checkbox]") !== null;
    const keys = event.shiftKey
      ? { ArrowLeft: () => turn(0.1, 0), ArrowRight: () => turn(-0.1, 0), ArrowUp: () => turn(0, 0.1), ArrowDown: () => turn(0, -0.1), "+": () => zoom(0.8) }
      : { ArrowLeft: () => by(-1), ArrowRight: () => by(1), Home: () => by(-Infinity), End: () => by(Infinity), "+": () => zoom(0.8), "-": () => zoom(1.25) };
    if (!press) keys[" "] = toggle;
    if (!(event.key in keys)) return;
    event.preventDefault();
    keys[event.key]();
  });

  if (works) {
    for (const panel of panels) {
      const canvas = panel.querySelector("canvas");
      canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
      canvas.addEventListener("pointermove", (event) => {
        if (canvas.hasPointerCapture(event.pointerId)) turn(event.movementX * 0.008, event.movementY * 0.008);
      });
      // The wheel alone scrolls the page.
      canvas.addEventListener("wheel", (event) => {
        if (!event.ctrlKey) return;
        event.preventDefault();
        zoom(Math.exp(event.deltaY * 0.002));
      }, { passive: false });
    }
    const resized = new ResizeObserver(() => stages.forEach((stage) => { stage.resize(); stage.render(view); }));
    panels.forEach((panel) => resized.observe(panel.querySelector(".labels")));
    stages.forEach((stage) => stage.resize());
  }
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", update);
  choose(scenes[0]);
  return { scenes, stages, works, view, state, choose, go, steps, setMode: (mode) => { state.mode = mode; go(0); } };
}

const viewer = startViewer();
