// node check.mjs FILE.mcap [EXPECTED.json]
//
// Reads a recording twice with MCAP's reference reader (as a stream, and by its index), every checksum on, and decodes
// every message by the IDL text that the recording carries. Each decoded message is encoded again and must give the
// same bytes: so no byte is left over, and no padding holds rubbish. Prints the messages per topic.
// EXPECTED.json, where given: {"topic": [message, …]}, 64-bit integers as texts, messages in the order of their
// log times.
// Exit status 0: nothing was found. 1: something was, one line each. 2: the arguments are wrong.
import { open, readFile } from "node:fs/promises";
import { crc32, crc32Final, crc32Init, crc32Update } from "@foxglove/crc";
import { parseIDL } from "@foxglove/omgidl-parser";
import { MessageReader } from "@foxglove/omgidl-serialization";
import zstd from "@foxglove/wasm-zstd";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";

const MAX_PROBLEMS = 20;
const SLICE_BYTES = 1 << 20;
const problems = [];

function problem(sentence) {
  if (problems.length < MAX_PROBLEMS) problems.push(sentence);
}

// A file as McapIndexedReader wants it.
class FileReadable {
  constructor(handle, size) {
    this.handle = handle;
    this.bytes = BigInt(size);
  }
  async size() {
    return this.bytes;
  }
  async read(offset, length) {
    if (offset < 0n || length < 0n || offset + length > this.bytes) {
      throw new Error(`bytes ${offset} to ${offset + length} lie outside of the file`);
    }
    const buffer = new Uint8Array(Number(length));
    const { bytesRead } = await this.handle.read(buffer, 0, buffer.length, Number(offset));
    if (bytesRead !== buffer.length) throw new Error(`the file ends within bytes ${offset} to ${offset + length}`);
    return buffer;
  }
}

// Encodes decoded values again as plain CDR (XCDR1: eight-byte numbers lie on eight bytes), padding zero.
class Encoder {
  static SCALARS = {
    bool: [1, "setUint8"], int8: [1, "setInt8"], uint8: [1, "setUint8"],
    int16: [2, "setInt16"], uint16: [2, "setUint16"],
    int32: [4, "setInt32"], uint32: [4, "setUint32"], int64: [8, "setBigInt64"], uint64: [8, "setBigUint64"],
    float32: [4, "setFloat32"], float64: [8, "setFloat64"],
  };

  constructor(definitions, original) {
    this.definitions = definitions;
    this.original = original;
    this.littleEndian = original[1] === 1;
    this.bytes = new Uint8Array(original.length); // writing beyond it throws
    this.view = new DataView(this.bytes.buffer);
    this.at = 4;
  }
  scalar(type, value) {
    const [size, set] = Encoder.SCALARS[type];
    this.at = 4 + Math.ceil((this.at - 4) / size) * size;
    this.view[set](this.at, value, this.littleEndian);
    // Not-a-number has many bit patterns, of which JavaScript keeps one.
    if (Number.isNaN(value)) for (let i = 0; i < size; ++i) this.bytes[this.at + i] = this.original[this.at + i];
    this.at += size;
  }
  text(value) {
    const utf8 = new TextEncoder().encode(value);
    this.scalar("uint32", utf8.length + 1);
    this.bytes.set(utf8, this.at);
    this.at += utf8.length + 1;
  }
  one(field, value) {
    if (field.isComplex) this.struct(field.type, value);
    else if (field.type === "string") this.text(value);
    else this.scalar(field.type, value);
  }
  array(field, lengths, value) {
    if (lengths.length === 0) return this.one(field, value);
    if (value.length !== lengths[0]) throw new Error(`${field.name} has ${value.length} elements, not ${lengths[0]}`);
    for (const element of value) this.array(field, lengths.slice(1), element);
  }
  struct(name, value) {
    const definition = this.definitions.find((one) => one.name === name);
    if (definition?.aggregatedKind !== "struct") throw new Error(`${name} is no struct`);
    for (const field of definition.definitions) {
      const inner = value[field.name];
      if (field.isArray && !field.arrayLengths) this.scalar("uint32", inner.length);
      this.array(field, field.isArray ? (field.arrayLengths ?? [inner.length]) : [], inner);
    }
  }
}

// Decodes the messages of one channel, whose schema is the IDL text.
class Decoder {
  constructor(channel, schema) {
    if (schema?.encoding !== "omgidl") throw new Error(`its schema's encoding is '${schema?.encoding}', not 'omgidl'`);
    if (channel.messageEncoding !== "cdr") throw new Error(`its encoding is '${channel.messageEncoding}', not 'cdr'`);
    this.definitions = parseIDL(new TextDecoder("utf-8", { fatal: true }).decode(schema.data));
    this.reader = new MessageReader(schema.name, this.definitions);
    this.schemaName = schema.name;
  }

  decode(data) {
    if (data[0] !== 0 || data[1] > 1)
      throw new Error(`its encapsulation is ${data[0]} ${data[1]}, plain CDR was expected`);
    const value = this.reader.readMessage(data);
    const encoder = new Encoder(this.definitions, data);
    encoder.struct(this.schemaName, value);
    const rest = data.length - encoder.at; // RTPS pads payloads to four bytes
    if (rest > 3) throw new Error(`it has ${data.length} bytes, its fields need ${encoder.at}`);
    for (let i = 4; i < data.length; ++i) {
      if (data[i] !== encoder.bytes[i]) {
        throw new Error(`byte ${i} is ${data[i]}, encoded again it is ${encoder.bytes[i]}`);
      }
    }
    return value;
  }
}

// Counts and a sum of checksums a topic: the same whatever the order of the messages.
class Tally {
  constructor() {
    this.byTopic = new Map();
  }
  add(topic, message) {
    const sum = this.byTopic.get(topic) ?? { count: 0, sum: 0 };
    sum.count += 1;
    sum.sum = (sum.sum + crc32(message.data) + (message.sequence ^ Number(message.logTime & 0xffffffffn))) >>> 0;
    this.byTopic.set(topic, sum);
  }
}

function plain(value) {
  if (typeof value === "bigint") return String(value);
  if (ArrayBuffer.isView(value) || Array.isArray(value)) return Array.from(value, plain);
  if (value !== null && typeof value === "object") {
    return Object.fromEntries(Object.entries(value).map(([key, inner]) => [key, plain(inner)]));
  }
  return value;
}

async function readAsStream(handle, size, decompressHandlers, tally) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  const schemas = new Map();
  const channels = new Map();
  const decoders = new Map();
  let dataCrc = undefined;
  for (let at = 0; at < size; at += SLICE_BYTES) {
    const slice = new Uint8Array(Math.min(SLICE_BYTES, size - at));
    await handle.read(slice, 0, slice.length, at);
    reader.append(slice);
    for (let record; (record = reader.nextRecord()); ) {
      if (record.type === "Schema") schemas.set(record.id, record);
      if (record.type === "DataEnd") dataCrc = record.dataSectionCrc;
      if (record.type === "Channel" && !channels.has(record.id)) {
        channels.set(record.id, record);
        try {
          decoders.set(record.id, new Decoder(record, schemas.get(record.schemaId)));
        } catch (error) {
          problem(`topic ${record.topic}: ${error.message}`);
        }
      }
      if (record.type !== "Message") continue;
      const { topic } = channels.get(record.channelId);
      tally.add(topic, record);
      try {
        decoders.get(record.channelId)?.decode(record.data);
      } catch (error) {
        problem(`topic ${topic}, message ${record.sequence} at ${record.logTime} ns: ${error.message}`);
      }
    }
  }
  if (!reader.done()) problem(`${reader.bytesRemaining()} bytes are left over at the end of the stream`);
  return { channels, schemas, dataCrc };
}

async function checkDataCrc(handle, dataEnd, expected) {
  let crc = crc32Init();
  for (let at = 0; at < dataEnd; at += SLICE_BYTES) {
    const slice = new Uint8Array(Math.min(SLICE_BYTES, dataEnd - at));
    await handle.read(slice, 0, slice.length, at);
    crc = crc32Update(crc, slice);
  }
  crc = crc32Final(crc);
  if (expected !== 0 && crc !== expected) problem(`the checksum of all data is ${crc}, ${expected} was expected`);
}

async function readByIndex(handle, size, decompressHandlers, tally, found) {
  const readable = new FileReadable(handle, size);
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  await checkDataCrc(handle, Number(reader.dataEndOffset), found.dataCrc ?? 0);
  let last = 0n;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    if (message.logTime < last) problem(`the index gives ${message.logTime} ns behind ${last} ns`);
    last = message.logTime;
    tally.add(reader.channelsById.get(message.channelId).topic, message);
  }
  for await (const attachment of reader.readAttachments({ validateCrcs: true })) {
    console.log(`attachment ${attachment.name}: ${attachment.data.length} bytes`);
  }
  for await (const metadata of reader.readMetadata()) {
    console.log(`metadata ${metadata.name}: ${metadata.metadata.size} entries`);
  }
  const counts = reader.statistics?.channelMessageCounts ?? new Map();
  const byTopic = new Map();
  for (const [id, count] of counts) {
    const { topic } = reader.channelsById.get(id);
    byTopic.set(topic, (byTopic.get(topic) ?? 0) + Number(count));
  }
  for (const [topic, { count }] of tally.byTopic) {
    if (byTopic.get(topic) !== count)
      problem(`topic ${topic}: the statistics name ${byTopic.get(topic)} messages of ${count}`);
  }
  for (const channel of found.channels.values()) {
    if (reader.channelsById.get(channel.id)?.topic !== channel.topic)
      problem(`topic ${channel.topic} is not in the summary`);
  }
  return reader;
}

function compareTallies(stream, index) {
  for (const [topic, sum] of stream.byTopic) {
    const other = index.byTopic.get(topic);
    if (other?.count !== sum.count || other?.sum !== sum.sum) {
      problem(`topic ${topic}: ${sum.count} messages as a stream, ${other?.count ?? 0} by the index, or others`);
    }
  }
}

async function compareWithExpected(reader, path) {
  const expected = JSON.parse(await readFile(path, "utf-8"));
  const decoders = new Map();
  const next = new Map();
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    if (!decoders.has(channel.id)) {
      decoders.set(channel.id, new Decoder(channel, reader.schemasById.get(channel.schemaId)));
    }
    const i = next.get(channel.topic) ?? 0;
    next.set(channel.topic, i + 1);
    const got = JSON.stringify(plain(decoders.get(channel.id).decode(message.data)));
    const wanted = JSON.stringify(expected[channel.topic]?.[i]);
    if (got !== wanted) problem(`topic ${channel.topic}, message ${i}: ${got} was read, ${wanted} was written`);
  }
  for (const [topic, messages] of Object.entries(expected)) {
    if ((next.get(topic) ?? 0) !== messages.length)
      problem(`topic ${topic}: ${next.get(topic) ?? 0} of ${messages.length} messages`);
  }
}

async function main(path, expectedPath) {
  await zstd.isLoaded;
  const decompressHandlers = { zstd: (buffer, size) => zstd.decompress(buffer, Number(size)) };
  const handle = await open(path);
  try {
    const { size } = await handle.stat();
    const stream = new Tally();
    const index = new Tally();
    const found = await readAsStream(handle, size, decompressHandlers, stream);
    const reader = await readByIndex(handle, size, decompressHandlers, index, found);
    compareTallies(stream, index);
    if (expectedPath) await compareWithExpected(reader, expectedPath);
    for (const channel of found.channels.values()) {
      const schema = found.schemas.get(channel.schemaId);
      const count = stream.byTopic.get(channel.topic)?.count ?? 0;
      console.log(`topic ${channel.topic} (${schema?.name}): ${count} messages`);
    }
  } finally {
    await handle.close();
  }
}

if (process.argv.length < 3 || process.argv.length > 4) {
  console.error("one argument was expected: a recording; optionally what it should hold: " +
    "node check.mjs FILE.mcap [EXPECTED.json]");
  process.exit(2);
}
try {
  await main(process.argv[2], process.argv[3]);
} catch (error) {
  problem(error.message);
}
for (const sentence of problems) console.log(`problem: ${sentence}`);
process.exitCode = problems.length === 0 ? 0 : 1;
