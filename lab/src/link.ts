// The whole scene in the fragment of the address: `#1.` and the deflated JSON in base64url. `carom link` reads and writes the same.

/** The version of the format that this page writes, and the newest it reads. */
export const VERSION = 1;

export class NewerLink extends Error {}

/** The fragment of a scene, without `#`. */
export async function encode(json: string): Promise<string> {
  const packed = await through(new TextEncoder().encode(json), new CompressionStream("deflate-raw"));
  let binary = "";
  for (const byte of packed) binary += String.fromCharCode(byte);
  return `${VERSION}.${btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "")}`;
}

/** The scene of a fragment; null if the fragment is not one of a scene. */
export async function decode(fragment: string): Promise<string | null> {
  const match = /^#?(\d+)\.([A-Za-z0-9_-]+)/.exec(fragment);
  if (!match) return null;
  if (Number(match[1]) > VERSION) throw new NewerLink(match[1]);
  const binary = atob(match[2].replaceAll("-", "+").replaceAll("_", "/"));
  const packed = Uint8Array.from(binary, (c) => c.charCodeAt(0));
  return new TextDecoder().decode(await through(packed, new DecompressionStream("deflate-raw")));
}

/** No scene that a link can hold is longer; a bomb is. */
const LONGEST = 4 << 20;

async function through(bytes: Uint8Array, stream: CompressionStream | DecompressionStream): Promise<Uint8Array> {
  const reader = new Blob([bytes as BlobPart]).stream().pipeThrough(stream as ReadableWritablePair<Uint8Array, Uint8Array<ArrayBuffer>>).getReader();
  const parts: Uint8Array[] = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    length += value.length;
    if (length > LONGEST) throw new Error("too long");
    parts.push(value);
  }
  const all = new Uint8Array(length);
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}
