// Reads the files of fields: VTK's XML format for unstructured grids, inline or appended, compressed by zlib or not.

/** Types of numbers by their names in the format. */
const TYPES = /** @type {Record<string, any>} */ ({ Float64: Float64Array, Float32: Float32Array, Int32: Int32Array, UInt64: BigUint64Array, Int64: BigInt64Array, UInt8: Uint8Array });
/** Bytes of a number of the headers, which are all of `UInt64`. */
const WORD = 8;

/**
 * Named arrays of a file.
 * @param {ArrayBuffer} file
 * @param {string[]} names
 * @returns {Promise<Record<string, Float64Array>>}
 */
export async function read_vtu(file, names) {
  // Every byte is a letter of this encoding, so that places in the text are those in the file.
  const text = new TextDecoder("latin1").decode(file);
  const data = text.indexOf("<AppendedData");
  const appended = data < 0 ? null : file.slice(text.indexOf("_", data) + 1);
  const root = new DOMParser().parseFromString(data < 0 ? text : `${text.slice(0, data)}</VTKFile>`, "application/xml").documentElement;
  const is_packed = root.hasAttribute("compressor");
  const arrays = await Promise.all(names.map(async (name) => {
    const node = root.querySelector(`DataArray[Name="${name}"]`);
    if (!node) throw new Error(`the file of fields has no ${name}`);
    const block = appended ? appended.slice(Number(node.getAttribute("offset"))) : decoded(node.textContent ?? "");
    const bytes = is_packed ? await unpacked(block) : block.slice(WORD, WORD + word(block, 0));
    return [name, Float64Array.from(new TYPES[node.getAttribute("type") ?? ""](bytes), Number)];
  }));
  return Object.fromEntries(arrays);
}

/** @param {string} base64 */
function decoded(base64) {
  return Uint8Array.from(atob(base64.trim()), (letter) => letter.charCodeAt(0)).buffer;
}

/**
 * @param {ArrayBuffer} bytes
 * @param {number} index
 */
function word(bytes, index) {
  return Number(new DataView(bytes).getBigUint64(WORD * index, true));
}

/**
 * The content of compressed blocks: their number, their size, that of the last one, their compressed sizes, then the blocks.
 * @param {ArrayBuffer} bytes
 */
async function unpacked(bytes) {
  const blocks = word(bytes, 0);
  const parts = [];
  let from = WORD * (3 + blocks);
  for (let block = 0; block < blocks; block += 1) {
    const to = from + word(bytes, 3 + block);
    parts.push(await new Response(new Blob([bytes.slice(from, to)]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer());
    from = to;
  }
  return new Blob(parts).arrayBuffer();
}
