#include "devices/runtime/show_store.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include <doctest/doctest.h>

#include "io/protocol/limits.h"
#include "io/protocol/show_chunks.h"
#include "tests/devices/runtime/sample_project.h"

namespace focalstage {
namespace {

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void put(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// A show of some 4 MiB: 28 images of noise.
struct Sample {
  sample::Folder folder;
  std::filesystem::path path = folder.path() / "show.h5";
  std::filesystem::path root = folder.path() / "store";

  Sample() {
    Project project = sample::project(512, 384);
    project.frames.count = 3;
    REQUIRE(sample::write_show(path, project));
  }

  ShowChunks chunks() const { return *ShowChunks::open(path, {}); }
};

Result<UploadProgress> begin(ShowStore& store, const ShowChunks& show) {
  return store.begin(show.sha256(), show.size_bytes(), show.chunk_sha256());
}

Status send(ShowStore& store, const ShowChunks& show, std::uint64_t from, std::uint64_t chunks_at_most) {
  for (std::uint64_t n = 0; n < chunks_at_most && from < show.size_bytes(); ++n) {
    const auto progress = store.add(show.sha256(), from, *show.read(from / push_chunk_bytes));
    if (!progress) return progress.fault();
    from = progress->received_bytes;
  }
  return {};
}

TEST_CASE("a show arrives in chunks, is verified, and is then found by its hash") {
  const Sample sample;
  const ShowChunks show = sample.chunks();
  REQUIRE(show.chunk_sha256().size() >= 4);
  auto store = *ShowStore::open(sample.root);
  CHECK(store->find(show.sha256()).fault().code == "rig.refused");
  CHECK(begin(*store, show)->received_bytes == 0);
  REQUIRE(send(*store, show, 0, 1000));
  CHECK(store->find(show.sha256()).fault().code == "rig.refused");
  const auto verified = store->finish(show.sha256());
  REQUIRE(verified);
  CHECK(verified->frames == 3);
  CHECK(verified->images == 8);
  CHECK(bytes_of(*store->find(show.sha256())) == bytes_of(sample.path));
  CHECK(begin(*store, show)->complete);
  CHECK(std::filesystem::is_empty(sample.root / "partial"));
}

TEST_CASE("a push that was cut goes on where it stopped, also in another runtime") {
  const Sample sample;
  const ShowChunks show = sample.chunks();
  {
    auto store = *ShowStore::open(sample.root);
    REQUIRE(begin(*store, show));
    REQUIRE(send(*store, show, 0, 2));
  }
  auto store = *ShowStore::open(sample.root);
  CHECK(store->add(show.sha256(), 2 * push_chunk_bytes, "x").fault().code == "rig.request");  // not begun here
  CHECK(begin(*store, show)->received_bytes == 2 * push_chunk_bytes);
  CHECK(store->finish(show.sha256()).fault().where.find("chunk 2 of ") == 0);
  REQUIRE(send(*store, show, 2 * push_chunk_bytes, 1000));
  CHECK(store->finish(show.sha256()));
}

TEST_CASE("what a crash left is checked: from the first chunk that is torn or other, it is sent again") {
  const Sample sample;
  const ShowChunks show = sample.chunks();
  const auto partial = sample.root / "partial" / (show.sha256() + ".part");
  auto store = *ShowStore::open(sample.root);
  REQUIRE(begin(*store, show));
  REQUIRE(send(*store, show, 0, 3));
  const std::string whole = bytes_of(partial);

  put(partial, whole.substr(0, 2 * push_chunk_bytes + 1234));
  CHECK(begin(*store, show)->received_bytes == 2 * push_chunk_bytes);
  std::string flipped = whole;
  flipped[push_chunk_bytes + 77] ^= 1;
  put(partial, flipped);
  CHECK(begin(*store, show)->received_bytes == push_chunk_bytes);
  put(partial, whole + "more than was sent");
  CHECK(begin(*store, show)->received_bytes == 3 * push_chunk_bytes);
  REQUIRE(send(*store, show, 3 * push_chunk_bytes, 1000));
  REQUIRE(store->finish(show.sha256()));
  CHECK(bytes_of(*store->find(show.sha256())) == bytes_of(sample.path));
}

TEST_CASE("one flipped bit on the way is refused with the chunk's name, and the right chunk is taken after it") {
  const Sample sample;
  const ShowChunks show = sample.chunks();
  auto store = *ShowStore::open(sample.root);
  REQUIRE(begin(*store, show));
  REQUIRE(send(*store, show, 0, 1));
  std::string data = *show.read(1);
  data[4711] ^= 0x10;
  const auto refused = store->add(show.sha256(), push_chunk_bytes, data);
  CHECK(refused.fault().code == "rig.damaged");
  CHECK(refused.fault().where.find("chunk 1 of ") == 0);
  REQUIRE(send(*store, show, push_chunk_bytes, 1000));
  CHECK(store->finish(show.sha256()));
}

TEST_CASE("chunks out of turn change nothing and are told where to go on") {
  const Sample sample;
  const ShowChunks show = sample.chunks();
  auto store = *ShowStore::open(sample.root);
  REQUIRE(begin(*store, show));
  CHECK(store->add(show.sha256(), 2 * push_chunk_bytes, *show.read(2))->received_bytes == 0);
  REQUIRE(send(*store, show, 0, 2));
  CHECK(store->add(show.sha256(), 0, *show.read(0))->received_bytes == 2 * push_chunk_bytes);
  const std::string half = show.read(2)->substr(0, 1000);
  CHECK(store->add(show.sha256(), 2 * push_chunk_bytes, half).fault().code == "rig.request");
}

TEST_CASE("what is no show is refused at the end and not kept") {
  const Sample sample;
  const std::string whole = bytes_of(sample.path);
  auto store = *ShowStore::open(sample.root);
  std::string flipped = whole;
  flipped[whole.size() / 2] ^= 4;
  for (const std::string& bytes :
       {flipped, whole.substr(0, whole.size() - 1), whole.substr(0, 600), std::string("x")}) {
    const auto path = sample.folder.path() / "bad.h5";
    put(path, bytes);
    const ShowChunks bad = *ShowChunks::open(path, {});
    REQUIRE(begin(*store, bad));
    REQUIRE(send(*store, bad, 0, 1000));
    const auto finished = store->finish(bad.sha256());
    CHECK(finished.fault().code == "rig.damaged");
    CHECK_FALSE(store->find(bad.sha256()));
  }
  CHECK(std::filesystem::is_empty(sample.root / "partial"));
  CHECK(std::filesystem::is_empty(sample.root / "shows"));
}

TEST_CASE("chunks that are as announced but not the show announced are refused") {
  const Sample sample;
  const ShowChunks show = sample.chunks();
  auto store = *ShowStore::open(sample.root);
  const std::string other(64, 'a');
  REQUIRE(store->begin(other, show.size_bytes(), show.chunk_sha256()));
  for (std::uint64_t chunk = 0; chunk < show.chunk_sha256().size(); ++chunk) {
    REQUIRE(store->add(other, chunk * push_chunk_bytes, *show.read(chunk)));
  }
  CHECK(store->finish(other).fault().code == "rig.damaged");
}

TEST_CASE("requests that make no sense are refused, above all names that leave the folder") {
  const sample::Folder folder;
  auto store = *ShowStore::open(folder.path());
  const std::vector<Sha256Value> one(1);
  for (const std::string& name : {std::string("../../etc/passwd"), std::string(), std::string(63, 'a'),
                                  std::string(64, 'A'), std::string(64, '/')}) {
    CHECK(store->begin(name, 10, one).fault().code == "rig.request");
    CHECK_FALSE(store->find(name));
  }
  const std::string name(64, '0');
  CHECK(store->begin(name, 0, {}).fault().code == "rig.request");
  CHECK(store->begin(name, show_limit_bytes + 1, one).fault().code == "rig.request");
  CHECK(store->begin(name, push_chunk_bytes + 1, one).fault().code == "rig.request");
  CHECK(store->finish(name).fault().code == "rig.request");
  // More than any disk of ours has free, and announced honestly.
  const std::uint64_t vast = show_limit_bytes;
  const auto space = std::filesystem::space(folder.path());
  if (space.available < vast) {
    const std::vector<Sha256Value> chunks(chunks_of(vast));
    CHECK(store->begin(name, vast, chunks).fault().code == "rig.disk-full");
  }
}

TEST_CASE("a store has one runtime") {
  const sample::Folder folder;
  auto first = ShowStore::open(folder.path());
  REQUIRE(first);
  CHECK(ShowStore::open(folder.path()).fault().code == "store.in-use");
  first->reset();
  CHECK(ShowStore::open(folder.path()));
}

TEST_CASE("a file is cut into chunks whose hashes are those of the whole's parts") {
  const sample::Folder folder;
  const auto path = folder.path() / "bytes";
  const std::string bytes(2 * push_chunk_bytes + 5, 'q');
  put(path, bytes);
  const ShowChunks chunks = *ShowChunks::open(path, {});
  CHECK(chunks.size_bytes() == bytes.size());
  CHECK(chunks.sha256() == hex(sha256_of(bytes)));
  REQUIRE(chunks.chunk_sha256().size() == 3);
  CHECK(chunks.chunk_sha256()[2] == sha256_of(std::string_view("qqqqq")));
  CHECK(chunks.read(2)->size() == 5);
  put(path, "shorter");
  CHECK(chunks.read(1).fault().code == "file.unreadable");
  put(path, "");
  CHECK(ShowChunks::open(path, {}).fault().code == "file.unreadable");
  CHECK(ShowChunks::open(folder.path() / "none", {}).fault().code == "file.missing");
  CHECK(ShowChunks::open(folder.path(), {}).fault().code == "file.unreadable");
}

}  // namespace
}  // namespace focalstage
