#include <cstdio>
#include <cstdlib>
#include <string>

#include "io/show/writer.h"
#include "tests/io/show/sample.h"

// Writes the sample show as a process of its own, for tests that kill it:
//   write_sample SHOW.h5 FRAMES WIDTH HEIGHT CHANNELS THREADS [--resume]
int main(int argc, char** argv) {
  if (argc < 7) return 2;
  const auto number = [&](int i) { return std::atoi(argv[i]); };
  const focalstage::ShowHeader header = focalstage::sample::header(number(2), number(3), number(4), number(5));
  const bool resume = argc > 7 && std::string(argv[7]) == "--resume";
  const auto failed = [](const focalstage::Fault& fault) {
    std::fprintf(stderr, "%s\n", focalstage::describe(fault).c_str());
    return fault.code == "show.disk-full" ? 4 : 3;
  };
  auto writer = focalstage::ShowWriter::start(argv[1], header, resume, number(6));
  if (!writer) return failed(writer.fault());
  for (int frame = 0; frame < header.frames; ++frame) {
    if (writer->has_frame(frame)) continue;
    const focalstage::Status added =
        writer->add_frame(frame, focalstage::sample::images(header, frame), focalstage::sample::measure(frame));
    if (!added) return failed(added.fault());
  }
  const focalstage::Status finished = writer->finish();
  return finished ? 0 : failed(finished.fault());
}
