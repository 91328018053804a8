#!/usr/bin/env bash
# Makes docs/gallery.md and its animations in docs/gallery, one of every show scene, and the README's. `scripts/gallery.sh
# NAME...` makes those alone; PROGRAM=... takes a program that is built already.
set -euo pipefail
cd "$(dirname "$0")/.."
program=${PROGRAM:-target/release/tiny-physics}
[ -n "${PROGRAM:-}" ] || cargo build -q --release
mkdir -p docs/gallery

# Name, options of `tiny-physics render`, what there is to see.
scenes() {
  cat <<'LIST'
fair | --steps 320 --size 640x360 --every 5 | What stands still beside what moves: a pool, a cradle, an arch, a pyramid, and a tower that a heavy ball knocks over.
wrecking_ball | --steps 300 | A heavy ball on a light chain: the chain does not stretch, the pyramid comes to rest.
harbour | --from 20 --steps 660 --every 8 | Light things float, heavy ones sink, wind drives a boat through them.
bowl | --from 30 --steps 240 | Shapes of every kind in a bowl drawn as a chain of segments.
joints | --steps 240 | Every kind of joint, side by side.
domino | --from 60 --steps 660 --every 8 --size 480x150 | A ball tips a row of dominoes.
hero | --from 30 --steps 600 --every 6 | A character walks slopes and steps, jumps through a platform, rides a shuttle.
car | --from 130 --steps 500 --every 6 | A car with driven wheels on hills.
ragdoll | --from 20 --steps 260 | Ragdolls tumble down stairs.
breaking_bridge | --from 30 --steps 330 --every 5 | A bridge whose joints break where the load is too much.
blast | --from 80 --steps 400 --every 6 --colors 64 | Three explosions in a town of planks.
galton_board | --from 60 --steps 960 --every 18 --size 288x360 --colors 64 | Balls heap up as a bell curve.
bullet_wall | --steps 90 --every 2 | Bullets at 400 m/s, shown slower: the wall behind is 2 cm thin.
clockwork | --steps 400 --every 6 | A motor, a train of wheels, and a rack that lifts a stack.
platforms | --steps 360 --every 5 | Led platforms keep their cargo; planks let balls through from below.
sorting | --from 500 --steps 860 --every 5 | Belts and gates sort parcels by their filters.
sensor_door | --from 120 --steps 540 --every 6 | A sensor opens a door.
changing | --from 60 --steps 540 --every 7 | A ball grows, a slope freezes, shelves come loose.
orbits | --steps 360 --every 5 --theme dark | Stones circle two planets, one of which has air.
bridge | --steps 160 --every 3 | A bridge of hinged planks carries crates and balls.
newton_cradle | --steps 214 --every 3 | Five balls hand a knock through.
friction_ramp | --steps 240 | Crates of rising friction on a slope: some slide, some stay.
character | --from 60 --steps 1500 --every 20 | The long way: hills, stairs, a lift, a shuttle, a plate that turns.
seed_demo | --steps 300 | Circles and boxes fall and come to rest.
pyramid | --steps 600 --every 60 | Ten seconds of a pyramid, which stands.
stack | --steps 600 --every 60 --size 240x400 | So does a tower of twenty.
card_house | --steps 600 --every 60 | A house of cards, held by friction alone, stands as well.
arch | --steps 600 --every 60 | And an arch without mortar.
LIST
}

draw() { # name options text: makes its animation and its part of the page.
  local name=$1 options=$2 text=$3 file=docs/gallery/$1.gif
  if [ -z "$only" ] || [[ " $only " == *" $name "* ]]; then
    local usual=""
    [[ $options == *--size* ]] || usual+=" --size 480x270"
    [[ $options == *--colors* ]] || usual+=" --colors 96"
    [[ $options == *--every* ]] || usual+=" --every 4"
    # shellcheck disable=SC2086
    $program render "$name" $usual $options -o "$file" >&2
  fi
  cells+=("![$name](gallery/$name.gif)<br>**$name**: $text")
}

only=$*
cells=()
while IFS='|' read -r name options text; do
  draw "${name// /}" "$options" "${text# }"
done < <(scenes)
{
  echo "# Gallery"
  echo
  echo "A loop of every scene that the program shows (\`tiny-physics list\`), drawn by \`scripts/gallery.sh\` with \`tiny-physics render\`."
  echo "\`tiny-physics view NAME\` plays one in a window, \`tiny-physics play NAME\` in the browser."
  echo
  echo "| | |"
  echo "|---|---|"
  for ((i = 0; i < ${#cells[@]}; i += 2)); do
    echo "| ${cells[i]} | ${cells[i + 1]:-} |"
  done
} >docs/gallery.md
