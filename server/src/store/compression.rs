//! Compression of what is stored: Brotli (RFC 7932).

use std::io::{Read, Write};

use brotli::{CompressorWriter, Decompressor};

/// Buffer of the compression, bytes.
const BUFFER: usize = 16 << 10;
/// Quality of the compression. A specification and its plan of 10 kB take 0.14 ms with 5, 0.10 with 6, 0.25 with 8 for 1 % less; 200 kB take 3 ms with
/// 4 and 5, 20 with 9.
const QUALITY: u32 = 5;
/// Logarithms of the compression's smallest and largest window, bytes: 256 kB and 4 MB. A window larger than what it compresses takes
/// memory and nothing else; up to 64 kB the compressor takes other tables, and 7 ms for 30 kB.
const WINDOW: (u32, u32) = (18, 22);

/// Compresses bytes.
pub(in crate::store) fn compress(bytes: &[u8]) -> Vec<u8> {
    let window = bytes.len().next_power_of_two().ilog2();
    let window = window.clamp(WINDOW.0, WINDOW.1);
    let mut writer = CompressorWriter::new(Vec::new(), BUFFER, QUALITY, window);
    // Writing to memory cannot fail.
    let _ = writer.write_all(bytes);
    writer.into_inner()
}

/// Decompresses up to the first damage that the format can find; damaged bytes may expand, up to twice the limit.
pub(in crate::store) fn decompress(bytes: &[u8], limit: usize) -> Vec<u8> {
    let mut content = Vec::new();
    let limit = u64::try_from(2 * limit).unwrap_or(u64::MAX);
    let mut reader = Decompressor::new(bytes, BUFFER).take(limit);
    // On an error, the bytes decompressed so far remain.
    let _ = reader.read_to_end(&mut content);
    content
}
