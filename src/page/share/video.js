// The film of the two bodies. It is drawn picture by picture, so it is the same on a slow machine.
import { make } from "../dom.js";
import { CanvasSurface } from "../drawing/surface.js";
import { ArrayBufferTarget, Muxer } from "./mp4-muxer.js";

const rate = 60;  // pictures a second
/** Codecs by their names in the file. H.264 plays everywhere; some builds of Chromium and Firefox cannot write it. */
const codecs = { avc: "avc1.640028", vp9: "vp09.00.40.08", av1: "av01.0.08M.08" };

/** The first codec that the browser can write. @throws {Error} if it can write none */
async function encodingOf(size) {
  for (const [name, codec] of Object.entries(codecs)) {
    const config = { ...size, codec, framerate: rate, bitrate: 5e6 };
    const found = await globalThis.VideoEncoder?.isConfigSupported(config).catch(() => null);
    if (found?.supported) return { name, config };
  }
  throw new Error("this browser cannot write films here; Chrome, Edge, Safari and Firefox 130 can, if the page is a file or comes by https");
}

/**
 * A film as MP4.
 * @param how      size in pixels; zoom: pixels of the film for a pixel of the surface; seconds: duration of the motion; rests: s that the last
 *   picture stays, so that it can be read
 * @param draw     draws on a surface the motion at a share of the time; the last picture has the share 1
 * @param tell     called after each second of the film with its finished share, from 0 to 1
 * @throws {Error}  if the browser's encoder fails, or returns fewer pictures than it was given
 */
export async function filmOf({ size, zoom, seconds, rests }, draw, tell) {
  const { name, config } = await encodingOf(size);
  const muxer = new Muxer({ target: new ArrayBufferTarget(), fastStart: "in-memory", video: { ...size, codec: name, frameRate: rate } });
  /** @type {Error | null} */
  let failure = null;
  /** @type {{chunk: EncodedVideoChunk, about: EncodedVideoChunkMetadata | undefined}[]} */
  const pictures = [];
  const encoder = new VideoEncoder({ output: (chunk, about) => pictures.push({ chunk, about }), error: (error) => (failure = error) });
  const surface = new CanvasSurface(make("canvas", size), { width: size.width / zoom, height: size.height / zoom });
  const count = Math.round(rate * (seconds + rests));
  try {
    encoder.configure(config);
    for (let i = 0; i < count; ++i) {
      if (i % rate === 0) tell(i / count);
      draw(surface, Math.min(1, i / (rate * seconds)));
      const picture = new VideoFrame(surface.canvas, { timestamp: (1e6 * i) / rate, duration: 1e6 / rate });
      encoder.encode(picture, { keyFrame: i % rate === 0 });
      picture.close();
      // The page stays usable, and few pictures wait for the encoder.
      do await new Promise((passed) => setTimeout(passed));
      while (encoder.encodeQueueSize > 4);
      if (failure) throw failure;
    }
    await encoder.flush();
  } finally {
    if (encoder.state !== "closed") encoder.close();
  }
  if (failure) throw failure;
  // H.264 of Firefox is in the order of decoding: a picture may come before one that is seen earlier. The file needs the
  // times of both. `late` pictures pass before the first is seen.
  const places = pictures.map(({ chunk }) => Math.round((chunk.timestamp * rate) / 1e6));
  if (new Set(places).size !== count) throw new Error(`the browser's encoder lost pictures: ${places.length} of ${count} came`);
  const late = places.reduce((most, place, i) => Math.max(most, i - place), 0);
  pictures.forEach(({ chunk, about }, i) => {
    const seen = (1e6 * (places[i] + late)) / rate;
    muxer.addVideoChunk(chunk, about, seen, seen - (1e6 * i) / rate);
  });
  muxer.finalize();
  return new Blob([muxer.target.buffer], { type: "video/mp4" });
}
