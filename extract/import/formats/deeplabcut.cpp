#include <algorithm>

#include "extract/import/formats/formats.h"
#include "extract/import/parsing/columns.h"
#include "extract/import/parsing/labels.h"
#include "extract/import/parsing/text.h"
#include "extract/io/error.h"

namespace stride::imports {
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

struct Animal {
  std::string id;
  PointColumns columns;
};

std::vector<Animal> find_animals(const Header& header, const std::string& file) {
  std::vector<Animal> animals;
  for (std::size_t c = 1; c < header.coords->cells.size(); ++c) {
    const std::string& coordinate = header.coords->cells[c];
    if (coordinate.empty()) continue;  // the index may take three columns
    const std::string id = header.individuals ? header.individuals->cells[c] : "single";
    auto animal = std::ranges::find(animals, id, &Animal::id);
    if (animal == animals.end()) animal = animals.insert(animal, Animal{id, {}});
    auto& columns = animal->columns.of(header.bodyparts->cells[c]);
    const std::size_t k = coordinate == "x" ? 0 : coordinate == "y" ? 1 : 2;
    require((k < 2 || coordinate == "likelihood") && columns[k] == PointColumns::kNone,
            "{}:{}: column {} = '{}': expected x, y and likelihood once for each body part", file,
            header.coords->number, c + 1, coordinate);
    columns[k] = c;
  }
  for (const Animal& animal : animals)
    for (std::size_t i = 0; i < animal.columns.labels.size(); ++i)
      require(animal.columns.columns[i][0] != PointColumns::kNone &&
                  animal.columns.columns[i][1] != PointColumns::kNone,
              "{}:{}: body part '{}': expected columns x and y", file, header.coords->number,
              animal.columns.labels[i]);
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

ImportedFile read_deeplabcut(std::string_view text, const std::string& file,
                             const ImportOptions& options) {
  const std::vector<TextLine> lines = read_text_table(text, file).lines;
  const Header header = read_header(lines, file);
  const std::vector<Animal> animals = find_animals(header, file);
  require(!animals.empty(), "{}:{}: expected columns after the first", file, header.coords->number);
  std::size_t first_column = header.coords->cells.size();
  for (const Animal& animal : animals)
    first_column = std::min(first_column, animal.columns.columns[0][0]);

  ImportedFile content;
  for (const Animal& animal : animals) {
    const LabelMap map(animal.columns.labels, options.labels, file);
    content.labels = animal.columns.labels;
    content.unused_labels = map.unused(animal.columns.labels);
    for (std::size_t row = header.rows; row < lines.size(); ++row) {
      check_width(lines[row], *header.coords, file);
      content.people.push_back({frame_of(lines[row], first_column, file), animal.id,
                                map.parts(animal.columns.points(lines[row], file))});
    }
  }
  return content;
}

}  // namespace

/// Analysis or labels, one or several animals.
const Format formats::deeplabcut{
    [](const FileText& text) {
      return if_so(text.first_cell() == "scorer" || text.first_cell() == "bodyparts",
                   Certainty::likely);
    },
    read_deeplabcut};

}  // namespace stride::imports
