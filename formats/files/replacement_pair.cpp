// SPDX-License-Identifier: Apache-2.0
#include <formats/files/replacement_pair.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <unistd.h>

namespace osio::files {

namespace {

/// Another name of a file's content, to give it back by; nothing where there is no such file.
Result<std::optional<ReplacementFile>> keep(const std::string& target) {
    if (::access(target.c_str(), F_OK) != 0)
        return std::nullopt;
    OSIO_TRY(ReplacementFile kept, ReplacementFile::create(target));
    ::unlink(kept.path().c_str());
    // Some file systems have no second names; there the old file is out of the way for a moment.
    if (::link(target.c_str(), kept.path().c_str()) != 0 &&
        std::rename(target.c_str(), kept.path().c_str()) != 0)
        return fail(ErrorCode::Io, std::string("cannot be replaced: ") + std::strerror(errno), target);
    return std::optional<ReplacementFile>(std::move(kept));
}

Result<void> give_back(std::optional<ReplacementFile>& kept, const std::string& target) {
    if (!kept) {
        ::unlink(target.c_str());
        return {};
    }
    const std::string name = kept->path();
    auto done = kept->commit();
    // rename(2) does nothing where both names have one content: the target was not replaced yet.
    if (done)
        ::unlink(name.c_str());
    return done;
}

}  // namespace

Result<void> commit_pair(ReplacementFile first, ReplacementFile second, Durability durability) {
    const std::string target = first.target();
    OSIO_TRY(auto kept, keep(target));
    auto done = first.commit(durability);
    if (done)
        done = second.commit(durability);
    if (done)
        return {};
    if (auto restored = give_back(kept, target); !restored)
        return fail(ErrorCode::Io, done.error().text() + "; and " + target +
                                       " could not be given its old content back: " + restored.error().what);
    return done;
}

}  // namespace osio::files
