#include <fmt/format.h>

#include <algorithm>

#include "extract/error.h"
#include "extract/import/formats.h"
#include "extract/import/labels.h"
#include "extract/import/text.h"

namespace stride {
namespace {

/// The header rows `scorer`, `individuals` (several animals only), `bodyparts`, `coords`.
struct Header {
  const TextLine* individuals = nullptr;
  const TextLine* bodyparts = nullptr;
  const TextLine* coords = nullptr;
  std::size_t rows = 0;
};

Header read_header(const std::vector<TextLine>& lines, const std::string& file) {
  Header header;
  for (const TextLine& line : lines) {
    const std::string& first = line.cells.front();
    if (first == "scorer") {
    } else if (first == "individuals") {
      header.individuals = &line;
    } else if (first == "bodyparts") {
      header.bodyparts = &line;
    } else if (first == "coords") {
      header.coords = &line;
    } else {
      break;
    }
    ++header.rows;
  }
  const int number = header.rows < lines.size() ? lines[header.rows].number : 1;
  require(header.bodyparts && header.coords,
          "{}:{}: expected DeepLabCut's header rows scorer, bodyparts, coords", file, number);
  require(
      header.bodyparts->cells.size() == header.coords->cells.size() &&
          (!header.individuals || header.individuals->cells.size() == header.coords->cells.size()),
      "{}:{}: {} cells, but {} in the row of bodyparts: expected as many", file,
      header.coords->number, header.coords->cells.size(), header.bodyparts->cells.size());
  return header;
}

/// Where one animal's points are: a column for each coordinate of each label, 0 = none.
struct Animal {
  std::string id;
  std::vector<std::string> labels;
  std::vector<std::array<std::size_t, 3>> columns;  // x, y, likelihood
};

std::vector<Animal> find_animals(const Header& header, const std::string& file) {
  std::vector<Animal> animals;
  for (std::size_t c = 1; c < header.coords->cells.size(); ++c) {
    const std::string& coordinate = header.coords->cells[c];
    const std::string& label = header.bodyparts->cells[c];
    if (coordinate.empty()) continue;  // the index may take three columns
    const std::string id = header.individuals ? header.individuals->cells[c] : "single";
    auto animal = std::ranges::find(animals, id, &Animal::id);
    if (animal == animals.end()) animal = animals.insert(animal, Animal{id, {}, {}});
    auto known = std::ranges::find(animal->labels, label);
    const auto i = static_cast<std::size_t>(known - animal->labels.begin());
    if (known == animal->labels.end()) {
      animal->labels.push_back(label);
      animal->columns.push_back({});
    }
    const auto k = std::string_view("xyl").find(coordinate.front());
    require((coordinate == "x" || coordinate == "y" || coordinate == "likelihood") &&
                animal->columns[i][k] == 0,
            "{}:{}: column {} = '{}': expected x, y and likelihood once for each body part", file,
            header.coords->number, c + 1, coordinate);
    animal->columns[i][k] = c;
  }
  for (const Animal& animal : animals)
    for (std::size_t i = 0; i < animal.labels.size(); ++i)
      require(animal.columns[i][0] > 0 && animal.columns[i][1] > 0,
              "{}:{}: body part '{}': expected columns x and y", file, header.coords->number,
              animal.labels[i]);
  return animals;
}

/// "12" of an analysed video; "labeled-data/run/img0012.png" of labels, whole or in three cells.
int frame_of(const TextLine& line, std::size_t first_column, const std::string& file) {
  if (const auto number = cell_number(line.cells.front()); number.has_value() && *number == *number)
    return frame_in(line, 0, file);
  const std::string& image = line.cells[std::min(first_column, line.cells.size()) - 1];
  const auto number = last_number(image.substr(0, image.rfind('.')));
  require(number.has_value(),
          "{}:{}: '{}': expected the number of a frame, or an image with one in its name", file,
          line.number, image);
  return *number;
}

}  // namespace

DetectedPeople read_deeplabcut(std::string_view content, const std::string& file,
                               const ImportOptions& options) {
  const std::vector<TextLine> lines = split_lines(content, ',');
  const Header header = read_header(lines, file);
  const std::vector<Animal> animals = find_animals(header, file);
  require(!animals.empty(), "{}:{}: expected columns after the first", file, header.coords->number);
  std::size_t first_column = header.coords->cells.size();
  for (const Animal& animal : animals) first_column = std::min(first_column, animal.columns[0][0]);

  DetectedPeople people;
  for (const Animal& animal : animals) {
    const LabelMap map(animal.labels, options.labels, file);
    for (std::size_t row = header.rows; row < lines.size(); ++row) {
      const TextLine& line = lines[row];
      require(line.cells.size() == header.coords->cells.size(),
              "{}:{}: {} cells, but the header has {}", file, line.number, line.cells.size(),
              header.coords->cells.size());
      std::vector<Point> points(animal.labels.size());
      for (std::size_t i = 0; i < points.size(); ++i) {
        const auto [x, y, likelihood] = animal.columns[i];
        points[i].p_px = {number_in(line, x, file), number_in(line, y, file)};
        points[i].confidence = likelihood > 0 ? number_in(line, likelihood, file) : 1;
      }
      people.push_back({frame_of(line, first_column, file), animal.id, map.parts(points)});
    }
  }
  return people;
}

}  // namespace stride
