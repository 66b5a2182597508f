// node values.mjs FILE.mcap [TOPIC]
//
// Decodes every message of a recording, or of one topic, by MCAP's reference reader and the IDL text that the recording
// carries. Prints a JSON line a message: {"topic", "source", "time", "value"}. 64-bit integers and numbers that JSON
// does not know (NaN, Infinity, -0) are texts. With --count it prints nothing but the number of messages, for
// measurements of decoding alone.
import { open } from "node:fs/promises";
import { parseIDL } from "@foxglove/omgidl-parser";
import { MessageReader } from "@foxglove/omgidl-serialization";
import zstd from "@foxglove/wasm-zstd";
import { McapStreamReader } from "@mcap/core";

const SLICE_BYTES = 1 << 20;

function plain(value) {
  if (typeof value === "bigint") return String(value);
  if (Object.is(value, -0)) return "-0";
  if (typeof value === "number" && !Number.isFinite(value)) return String(value);
  if (ArrayBuffer.isView(value) || Array.isArray(value)) return Array.from(value, plain);
  if (value !== null && typeof value === "object") {
    return Object.fromEntries(Object.entries(value).map(([key, inner]) => [key, plain(inner)]));
  }
  return value;
}

async function main(path, wanted, onlyCount) {
  await zstd.isLoaded;
  const reader = new McapStreamReader({
    decompressHandlers: { zstd: (buffer, size) => zstd.decompress(buffer, Number(size)) },
    validateCrcs: true,
  });
  const handle = await open(path);
  const { size } = await handle.stat();
  const schemas = new Map();
  const channels = new Map();
  const readers = new Map();
  let count = 0;
  let lines = [];
  for (let at = 0; at < size; at += SLICE_BYTES) {
    const slice = new Uint8Array(Math.min(SLICE_BYTES, size - at));
    await handle.read(slice, 0, slice.length, at);
    reader.append(slice);
    for (let record; (record = reader.nextRecord()); ) {
      if (record.type === "Schema") schemas.set(record.id, record);
      if (record.type === "Channel" && !channels.has(record.id)) {
        channels.set(record.id, record);
        const schema = schemas.get(record.schemaId);
        const definitions = parseIDL(new TextDecoder().decode(schema.data));
        readers.set(record.id, new MessageReader(schema.name, definitions));
      }
      if (record.type !== "Message") continue;
      const channel = channels.get(record.channelId);
      if (wanted !== undefined && channel.topic !== wanted) continue;
      const value = readers.get(record.channelId).readMessage(record.data);
      ++count;
      if (onlyCount) continue;
      const source = channel.metadata.get("source");
      lines.push(JSON.stringify({ topic: channel.topic, source, time: String(record.logTime), value: plain(value) }));
      if (lines.length === 1000) {
        process.stdout.write(lines.join("\n") + "\n");
        lines = [];
      }
    }
  }
  if (lines.length > 0) process.stdout.write(lines.join("\n") + "\n");
  if (onlyCount) console.log(count);
  await handle.close();
}

const words = process.argv.slice(2);
const files = words.filter((word) => word !== "--count");
if (files.length < 1 || files.length > 2) {
  console.error("a recording was expected, and a topic at most: node values.mjs FILE.mcap [TOPIC] [--count]");
  process.exit(2);
}
await main(files[0], files[1], words.length > files.length);
