# What do the differences between the paper's text and its released code do to the ranks of robots?
# Every variant that has walks of its own: name, minutes, label, and whether it is on request.
# shellcheck disable=SC2154  # $study is that of run_experiment.sh
while IFS='|' read -r variant minutes label on_request; do
  "part${on_request:+_on_request}" "$variant" "$minutes min" "$label"
  eval "$variant() { walks $variant; }"
done < <(awk -F ' = ' '
  function print_variant() { if (name != "" && !shares) print name "|" minutes "|" label "|" on_request }
  /^\[/ { print_variant(); name = substr($0, 2, length($0) - 2); minutes = 10; label = on_request = ""; shares = 0 }
  $1 == "label" { label = substr($2, 2, length($2) - 2) }
  $1 == "cost_min" { minutes = $2 }
  $1 == "on_request" { on_request = "yes" }
  $1 == "walks_of" { shares = 1 }
  END { print_variant() }' "$study/variants.toml")
part bodies "10 s" "which bodies random networks grow into, in the text and in the released code"
part in_flight "2 min" "robots without gravity, floor and drag, which nothing but their beams can turn"
part summary "1 min" "the tables and the picture of all variants that there are"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
bodies() {
  local file name
  "$study/bodies.py" studies "$results/bodies"
  for file in "$results"/bodies/*.toml; do
    name=${file%.toml}
    rm -f "$name".sqlite*
    menger evolve "$file" --output "$name.sqlite"
    menger export "$name.sqlite" --output "$name" --individuals --levels 1 --no-frames --no-pictures
  done
  "$study/bodies.py" take "$results/bodies"
}

in_flight() {
  "$study/in_flight.py" scenes "$results/in_flight"
  simulate_scenes "$results/in_flight"
  "$study/in_flight.py" take "$results/in_flight"
}

summary() { "$study/discrepancies.py" summary; }

# The walks of a variant, if they are not there already: a clone has those of most. To make them anew, remove walks/NAME.csv.
walks() {
  if [ -e "$study/walks/$1.csv" ]; then
    say "discrepancies: $study/walks/$1.csv is there; remove it to make it anew"
    return
  fi
  "$study/discrepancies.py" study "$1" "$results/$1.toml"
  menger evolve "$results/$1.toml" --output "$results/$1.sqlite"
  menger export "$results/$1.sqlite" --output "$results/$1" --individuals --levels 1 --no-frames --no-pictures
  "$study/discrepancies.py" take "$results/$1/individuals.csv" "$1"
}
