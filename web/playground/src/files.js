// Links, files and pictures.

import { applyPalette, GIFEncoder, quantize } from "gifenc";
import { $, download, toast } from "./dom.js";

// A link holds the whole scene: packed and written in letters that addresses may have.

async function through(stream, bytes) {
  const packed = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(packed).arrayBuffer());
}

export async function toLink(text) {
  const bytes = await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(text));
  let letters = "";
  for (const byte of bytes) letters += String.fromCharCode(byte);
  return btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

export async function fromLink(letters) {
  const bytes = Uint8Array.from(atob(letters.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
  return new TextDecoder().decode(await through(new DecompressionStream("deflate-raw"), bytes));
}

/** Longest link that mail programs and chats leave whole. */
const LONGEST = 60_000;

export async function share(app) {
  if (!app.source) return toast("A recording is not part of a link: save it as a file.", "bad");
  const letters = await toLink(compact(app.source));
  if (letters.length > LONGEST) return toast("The scene is too large for a link: save it as a file.", "bad");
  history.replaceState(undefined, "", `#s=${letters}`);
  try {
    await navigator.clipboard.writeText(location.href);
    toast("Link copied: it holds the whole scene");
  } catch {
    toast("The address of this page now holds the whole scene");
  }
}

function compact(text) {
  // Numbers stay as they are written; only the space between goes.
  return text.replace(/("(?:[^"\\]|\\.)*")|\s+/g, (_, string) => string ?? "");
}

export function files(app) {
  const input = $("#file");
  input.onchange = () => {
    if (input.files[0]) open(input.files[0]);
    input.value = "";
  };

  async function open(file) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    openBytes(bytes, file.name);
  }

  function openBytes(bytes, name) {
    const title = name.replace(/\.(json|tpr)$/, "");
    try {
      const recorded = String.fromCharCode(...bytes.subarray(0, 3)) === "tpr";
      if (recorded) app.openRecording(bytes, title);
      else app.open(new TextDecoder().decode(bytes), { name: title });
    } catch (error) {
      app.say("error", `${name}: ${error.message}`);
    }
  }

  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    const [file] = event.dataTransfer.files;
    if (file) open(file);
  });

  const name = (ending) => `${app.name.replace(/[^\w-]+/g, "_") || "scene"}.${ending}`;

  return {
    openBytes,
    choose: () => input.click(),
    saveScene: () =>
      app.source
        ? download(name("json"), new Blob([app.source], { type: "application/json" }))
        : toast("A recording has no scene file: save it as a recording.", "bad"),
    saveRecording: () => download(name("tpr"), new Blob([app.world.recording()])),
    png: () => {
      app.draw();
      app.renderer.canvas.toBlob((blob) => download(name("png"), blob));
    },
    gif: () => gif(app, name("gif")),
    webm: () => webm(app, name("webm")),
  };
}

const SECONDS = 4;

/** The next seconds as an animation; the run goes on meanwhile. */
async function gif(app, name) {
  const { canvas } = app.renderer;
  const scale = Math.min(1, 640 / canvas.width);
  const [width, height] = [Math.round(canvas.width * scale), Math.round(canvas.height * scale)];
  const small = new OffscreenCanvas(width, height);
  const context = small.getContext("2d", { willReadFrequently: true });
  const encoder = GIFEncoder();
  toast(`Recording ${SECONDS} seconds…`);
  const was = app.playing;
  app.setPlaying(false);
  let made = 0;
  for (let i = 1; i <= SECONDS * 25; i++) {
    // Steps and pictures have lengths of their own: as many as are due by then.
    for (const due = Math.round((0.04 * i) / app.world.dt); made < due; made++) app.advance();
    app.draw();
    context.drawImage(canvas, 0, 0, width, height);
    const { data } = context.getImageData(0, 0, width, height);
    const palette = quantize(data, 128);
    encoder.writeFrame(applyPalette(data, palette), width, height, { palette, delay: 40 });
    app.say("time");
    // The page stays alive.
    await new Promise((next) => setTimeout(next));
  }
  encoder.finish();
  download(name, new Blob([encoder.bytes()], { type: "image/gif" }));
  app.setPlaying(was);
  toast("Animation saved");
}

const WEBM = "video/webm";

function webm(app, name) {
  if (!globalThis.MediaRecorder?.isTypeSupported(WEBM)) {
    return toast("This browser cannot record a film: save an animation (GIF) instead.", "bad");
  }
  const stream = app.renderer.canvas.captureStream(60);
  const recorder = new MediaRecorder(stream, { mimeType: WEBM, videoBitsPerSecond: 8_000_000 });
  const parts = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  recorder.onstop = () => {
    download(name, new Blob(parts, { type: WEBM }));
    toast("Film saved");
  };
  toast(`Recording ${SECONDS} seconds…`);
  app.setPlaying(true);
  recorder.start();
  setTimeout(() => recorder.stop(), SECONDS * 1000);
}
