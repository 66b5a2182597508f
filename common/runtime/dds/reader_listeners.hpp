// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::dds {

// Fast DDS 2.9.1 takes the listener from a reader that is being deleted, while the thread that matches this reader with
// a writer looks for the listener and then calls it: a null pointer is called (its issue 3303). So a node that asked
// for the world and deleted the reader of the answer could die of SIGSEGV while it started. In a program that calls
// this function such a reader gets a listener that does nothing instead of none. It is deleted only when no thread
// matches it any more: the library waits for that.
//
// It does so by taking the place of a function of the library (see the .cpp); calling it links that in, and it returns
// whether it is the one that the whole program uses.
bool DeletedReadersHaveListeners();

}  // namespace rodeira::dds
