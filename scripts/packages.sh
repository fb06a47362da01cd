# SPDX-License-Identifier: Apache-2.0
# Debian packages by purpose, and their installation. To be sourced.

# What building and running needs.
OSIO_PACKAGES="g++ cmake ninja-build pkg-config
    libopenimageio-dev libopencolorio-dev libopenexr-dev libimath-dev libhwy-dev libdeflate-dev
    libtiff-dev libpng-dev libpugixml-dev
    libcli11-dev libfmt-dev nlohmann-json3-dev libexpected-dev libxxhash-dev
    openimageio-tools fonts-dejavu-core"

# What the tests drive besides.
OSIO_TEST_PACKAGES="libgtest-dev openexr opencolorio-tools
    python3 python3-numpy python3-openimageio python3-gdal chromium"

# What fuzzing needs besides.
OSIO_FUZZ_PACKAGES="clang-14 libclang-rt-14-dev"

# ensure_packages NAME ...: installs those that are missing; silent where none is.
ensure_packages() {
    missing=""
    for package in "$@"; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q "ok installed" ||
            missing="$missing $package"
    done
    [ -z "$missing" ] && return 0
    echo "installing:$missing"
    as_root=""
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || {
            echo "these Debian packages are needed; install them as root:$missing" >&2
            return 1
        }
        as_root="sudo"
    fi
    $as_root apt-get update -qq &&
        $as_root env DEBIAN_FRONTEND=noninteractive \
            apt-get install -y -qq --no-install-recommends $missing >/dev/null
}
