#pragma once

#include <memory>
#include <vector>

namespace contensou::program {

/// One thread's part in work on a long sequence of pieces; it holds one piece at a time.
class PieceWorker {
 public:
  virtual ~PieceWorker() = default;

  /// Takes the next piece; false if there is none. Workers take turns.
  virtual bool take() = 0;

  /// Does what the piece asks for, while other workers do theirs.
  virtual void work() = 0;

  /// Hands the result on. Workers take turns, in the order in which they took their pieces.
  virtual void hand_on() = 0;
};

/// Works on all pieces, each worker in a thread of its own. Memory is that of one piece for each worker, and what is
/// handed on does not depend on how many workers there are.
///
/// @throws  the exception of the first piece, in their order, that threw one; nothing is handed on after it
void work_in_order(const std::vector<std::unique_ptr<PieceWorker>>& workers);

}  // namespace contensou::program
