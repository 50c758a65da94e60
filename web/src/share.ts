// A link that holds the text: deflated, in base64 that addresses take, behind the `#`.

export interface Shared {
  text: string;
  /** Files that the text names, by their names. */
  files?: Record<string, string>;
  job?: string;
  pose?: number;
}

/** The part of an address behind `#` that holds a file. */
export async function toHash(shared: Shared): Promise<string> {
  const bytes = await through(new TextEncoder().encode(JSON.stringify(shared)), new CompressionStream('deflate-raw'));
  return `#s=${base64(bytes)}`;
}

/** The file that an address holds, or `null` where it holds none. */
export async function fromHash(hash: string): Promise<Shared | null> {
  const packed = /^#s=([A-Za-z0-9_-]+)$/.exec(hash)?.[1];
  if (!packed) {
    return null;
  }
  try {
    const bytes = await through(unBase64(packed), new DecompressionStream('deflate-raw'));
    const shared: unknown = JSON.parse(new TextDecoder().decode(bytes));
    const text = (shared as Shared | null)?.text;
    return typeof text === 'string' ? (shared as Shared) : null;
  } catch {
    return null;
  }
}

/** Bytes from a stream that packs or unpacks. */
export async function through(bytes: Uint8Array<ArrayBuffer>, stream: GenericTransformStream): Promise<Uint8Array<ArrayBuffer>> {
  const out = new Blob([bytes]).stream().pipeThrough(stream as unknown as ReadableWritablePair<Uint8Array, Uint8Array>);
  return new Uint8Array(await new Response(out as unknown as BodyInit).arrayBuffer());
}

function base64(bytes: Uint8Array): string {
  let binary = '';
  for (const byte of bytes) {
    binary += String.fromCharCode(byte);
  }
  return btoa(binary).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

/** Bytes of base64, the plain one or that of addresses. */
export function unBase64(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text.replaceAll('-', '+').replaceAll('_', '/'));
  return Uint8Array.from(binary, (letter) => letter.charCodeAt(0));
}
