#include "io/protocol/limits.h"

#include <grpc/support/log.h>

namespace focalstage {

void silence_grpc() {
  gpr_set_log_function([](gpr_log_func_args*) {});
}

}  // namespace focalstage
