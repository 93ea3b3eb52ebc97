// Prints what the npm readers see of an MCAP file: per topic the count, and the first and last message.
import { open } from "node:fs/promises";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader } from "@mcap/core";
import { decompress } from "fzstd";

const file = await open(process.argv[2]);
const { size } = await file.stat();
const readable = {
  size: async () => BigInt(size),
  read: async (offset, length) => {
    const bytes = new Uint8Array(Number(length));
    await file.read(bytes, 0, bytes.length, Number(offset));
    return bytes;
  },
};
const reader = await McapIndexedReader.Initialize({
  readable,
  decompressHandlers: { zstd: (data, length) => decompress(data, new Uint8Array(Number(length))) },
});
const decoders = new Map();
const topics = {};
for await (const message of reader.readMessages({ validateCrcs: true })) {
  const channel = reader.channelsById.get(message.channelId);
  if (!decoders.has(channel.schemaId)) {
    const schema = reader.schemasById.get(channel.schemaId);
    const definition = parse(new TextDecoder().decode(schema.data), { ros2: true });
    decoders.set(channel.schemaId, new MessageReader(definition));
  }
  const decoded = decoders.get(channel.schemaId).readMessage(message.data);
  const topic = (topics[channel.topic] ??= { count: 0, first: decoded });
  topic.count += 1;
  topic.last = decoded;
}
await file.close();
const plain = (_key, value) =>
  typeof value === "bigint" ? Number(value) : ArrayBuffer.isView(value) ? Array.from(value) : value;
console.log(JSON.stringify({ profile: reader.header.profile, topics }, plain));
