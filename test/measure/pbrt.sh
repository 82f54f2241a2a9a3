# pbrt.sh: pbrt-v3 and the published scenes for it. peers.sh and pbrt_references.sh read it by
# `. test/measure/pbrt.sh`, from the top. $dir is a folder that goes away in the end.
absolute() { case $1 in /* | "") echo "$1" ;; *) echo "$PWD/$1" ;; esac; }
PEERS=$(absolute "${PEERS-}")
PUBLISHED=$(absolute "${PUBLISHED-}")
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
pbrt=$PEERS/pbrt
[ -x "$pbrt" ] || pbrt=$PEERS/pbrt-v3/build/pbrt

# published_scenes: name, width, height, longest path, and by which integrator and samples its reference is.
published_scenes() {
    cat <<SCENES
cornell-box 128 128 6 bdpt 1024
cornell-box-modified 128 128 6 bdpt 1024
veach-ajar 160 90 8 bdpt 4096
bathroom 128 128 8 bdpt 1024
living-room 160 90 8 path 4096
SCENES
}

# pbrt_scene INTEGRATOR SAMPLES: $dir/$scene/run.pbrt, which is $scene of $width x $height pixels and paths of $depth.
pbrt_scene() {
    [ -d "$dir/$scene" ] || { mkdir "$dir/$scene" && ln -s "$PUBLISHED/$scene"/* "$dir/$scene/"; }
    sed -E -e "s/^Integrator .*/Integrator \"$1\" \"integer maxdepth\" $depth/" \
        -e "s/^Sampler .*/Sampler \"random\" \"integer pixelsamples\" $2/" -e 's/^PixelFilter .*/PixelFilter "box"/' \
        -e "s/^Film .*/Film \"image\" \"string filename\" \"x.exr\"/" \
        -e "/^Film/s/\$/ \"integer xresolution\" $width \"integer yresolution\" $height/" \
        "$PUBLISHED/$scene/scene.pbrt" >"$dir/$scene/run.pbrt"
}
