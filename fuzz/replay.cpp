// SPDX-License-Identifier: Apache-2.0
//
// Runs a target over every file of the folders that are named; at least one must be there.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <fuzz/target.h>
#include <iterator>
#include <string>

int main(int argc, char** argv) {
    std::size_t ran = 0;
    for (int i = 1; i < argc; ++i)
        for (const auto& entry : std::filesystem::directory_iterator(argv[i])) {
            std::ifstream in(entry.path(), std::ios::binary);
            const std::string bytes((std::istreambuf_iterator<char>(in)), {});
            LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
            ++ran;
        }
    std::printf("%zu inputs\n", ran);
    return ran == 0 ? 1 : 0;
}
