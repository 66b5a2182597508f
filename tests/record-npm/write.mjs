// node write.mjs FOLDER
//
// Writes one recording for every combination of the options of MCAP's reference writer, without compression, with zstd,
// and in one large chunk. Each holds the same 60 messages, 0.1 s apart: every third on /slow, the others on /fast, the
// data {"n":NUMBER}; a channel without a message; before them an attachment and the metadata record "about" (behind
// messages outside of chunks the writer's index names other places than theirs).
import { open } from "node:fs/promises";
import zstd from "@foxglove/wasm-zstd";
import { McapWriter } from "@mcap/core";

const OPTIONS = ["useStatistics", "useSummaryOffsets", "useChunks", "repeatSchemas", "repeatChannels",
  "useMessageIndex", "useChunkIndex", "useAttachmentIndex"];

class FileWritable {
  constructor(handle) {
    this.handle = handle;
    this.written = 0;
  }
  position() {
    return BigInt(this.written);
  }
  async write(buffer) {
    await this.handle.write(buffer);
    this.written += buffer.byteLength;
  }
}

async function write(path, options) {
  const handle = await open(path, "w");
  const writer = new McapWriter({ writable: new FileWritable(handle), ...options });
  await writer.start({ profile: "", library: "reference" });
  const schemaId = await writer.registerSchema({
    name: "Number", encoding: "jsonschema", data: new TextEncoder().encode('{"type":"object"}') });
  const channels = [];
  for (const topic of ["/fast", "/slow", "/silent"]) {
    channels.push(await writer.registerChannel({ schemaId, topic, messageEncoding: "json", metadata: new Map() }));
  }
  await writer.addAttachment({ logTime: 1n, createTime: 2n, name: "file.txt", mediaType: "text/plain",
    data: new TextEncoder().encode("data") });
  await writer.addMetadata({ name: "about", metadata: new Map([["key", "value"]]) });
  for (let n = 0; n < 60; ++n) {
    const time = BigInt(n) * 100_000_000n;
    await writer.addMessage({ channelId: channels[n % 3 === 0 ? 1 : 0], sequence: n, logTime: time, publishTime: time,
      data: new TextEncoder().encode(`{"n":${n}}`) });
  }
  await writer.end();
  await handle.close();
}

if (process.argv.length !== 3) {
  console.error("one argument was expected: a folder");
  process.exit(2);
}
await zstd.isLoaded;
const packed = { zstd: (data) => ({ compression: "zstd", compressedData: zstd.compress(data) }) };
for (let bits = 0; bits < 1 << OPTIONS.length; ++bits) {
  const options = Object.fromEntries(OPTIONS.map((name, i) => [name, (bits >> i) % 2 === 1]));
  options.useMetadataIndex = options.useAttachmentIndex;
  await write(`${process.argv[2]}/plain-${bits}.mcap`, { ...options, chunkSize: 200 });
  await write(`${process.argv[2]}/zstd-${bits}.mcap`, { ...options, chunkSize: 200, compressChunk: packed.zstd });
  await write(`${process.argv[2]}/large-${bits}.mcap`, options);
}
