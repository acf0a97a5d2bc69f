#include "emulator/behaviour/document.h"

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <unordered_set>

#include "emulator/behaviour/parse_json.h"

namespace fauxboard::behaviour {
namespace {

constexpr std::size_t max_chain = 8;

std::string escape_pointer(std::string_view key) {
    std::string out;
    for (const char c : key) {
        out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    }
    return out;
}

/// Hands the text to the JSON parser and counts lines as it goes. The parser reads one byte ahead after a
/// number, so the line that counts is that of the last byte which is no white space.
struct Cursor {
    std::size_t line = 1;
    std::size_t token_line = 1;
};

class CountingIterator {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    CountingIterator(const char* at, Cursor* cursor) : at_(at), cursor_(cursor) {}
    const char& operator*() const { return *at_; }
    CountingIterator& operator++() {
        if (*at_ == '\n') {
            ++cursor_->line;
        } else if (*at_ != ' ' && *at_ != '\t' && *at_ != '\r') {
            cursor_->token_line = cursor_->line;
        }
        ++at_;
        return *this;
    }
    friend bool operator==(const CountingIterator& a, const CountingIterator& b) { return a.at_ == b.at_; }

  private:
    const char* at_;
    Cursor* cursor_;
};

/// Builds the document from the parser's events, noting each value's line.
class Builder {
  public:
    using number_integer_t = Json::number_integer_t;
    using number_unsigned_t = Json::number_unsigned_t;
    using number_float_t = Json::number_float_t;
    using string_t = Json::string_t;
    using binary_t = Json::binary_t;

    Builder(Document& document, const Cursor& cursor) : document_(document), cursor_(cursor) {}

    bool null() { return value(nullptr); }
    bool boolean(bool v) { return value(v); }
    bool number_integer(number_integer_t v) { return value(v); }
    bool number_unsigned(number_unsigned_t v) { return value(v); }
    bool number_float(number_float_t v, const string_t&) { return value(v); }
    bool string(string_t& v) { return value(v); }
    bool binary(binary_t&) { return false; }
    bool start_object(std::size_t) { return open(Json::object()); }
    bool end_object() { return close(); }
    bool start_array(std::size_t) { return open(Json::array()); }
    bool end_array() { return close(); }

    bool key(string_t& name) {
        if (!levels_.back().keys.insert(name).second) {
            document_.places[pointer() + "/" + escape_pointer(name)] = {0, cursor_.token_line};
            problems.push_back(
                document_.problem(pointer() + "/" + escape_pointer(name), "the key is given twice"));
        }
        key_ = name;
        return true;
    }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) {
        std::string message = error.what();
        const std::size_t bracket = message.find("] ");
        Problem problem =
            document_.problem("", bracket == std::string::npos ? message : message.substr(bracket + 2));
        problem.line = cursor_.line;
        problem.message = "not JSON: " + problem.message;
        problems.push_back(std::move(problem));
        return false;
    }

    std::vector<Problem> problems;

  private:
    struct Level {
        Json* node;
        std::string pointer;
        std::unordered_set<std::string> keys{};  ///< the object itself would be searched from its start
    };

    const std::string& pointer() const {
        static const std::string root;
        return levels_.empty() ? root : levels_.back().pointer;
    }

    Json* place(Json v, std::string& where) {
        if (levels_.empty()) {
            document_.root = std::move(v);
            return &document_.root;
        }
        Json& parent = *levels_.back().node;
        if (parent.is_array()) {
            where = pointer() + "/" + std::to_string(parent.size());
            parent.push_back(std::move(v));
            return &parent.back();
        }
        where = pointer() + "/" + escape_pointer(key_);
        auto& members = parent.get_ref<Json::object_t&>();
        members.emplace_back(key_, std::move(v));  // a key given twice is a problem already
        return &members.back().second;
    }

    bool value(Json v) {
        std::string where;
        place(std::move(v), where);
        document_.places[where] = {0, cursor_.token_line};
        return true;
    }

    bool open(Json v) {
        std::string where;
        if (levels_.size() >= most_levels) {
            problems.push_back(document_.problem(pointer(), "nested deeper than 64 levels"));
            return false;
        }
        Json* node = place(std::move(v), where);
        document_.places[where] = {0, cursor_.token_line};
        levels_.push_back({node, where});
        return true;
    }

    bool close() {
        levels_.pop_back();
        return true;
    }

    Document& document_;
    const Cursor& cursor_;
    std::vector<Level> levels_;
    std::string key_;
};

void forget_places(Document& document, const std::string& pointer) {
    const std::string below = pointer + "/";
    auto& places = document.places;
    places.erase(pointer);
    const auto from = places.lower_bound(below);
    auto to = from;
    while (to != places.end() && to->first.starts_with(below)) {
        ++to;
    }
    places.erase(from, to);
}

void take_places(Document& into, const Document& from, const std::string& pointer, std::size_t file_shift) {
    const std::string below = pointer + "/";
    for (auto it = from.places.lower_bound(pointer);
         it != from.places.end() && it->first.starts_with(pointer); ++it) {
        if (it->first == pointer || it->first.starts_with(below)) {
            into.places[it->first] = {it->second.file + file_shift, it->second.line};
        }
    }
}

/// An object's members while another one is laid over it. The object keeps the order of its keys and is
/// searched from its start, which for large ones would take as long as all of it each time.
class Members {
  public:
    explicit Members(Json& object) : members_(object.get_ref<Json::object_t&>()) {
        for (std::size_t i = 0; i < members_.size(); ++i) {
            index_.emplace(member(i).first, i);
        }
    }
    /// The member of that name, made where there is none. Good until the next one is made.
    Json& at(const std::string& key) {
        const auto [it, made] = index_.try_emplace(key, members_.size());
        if (made) {
            members_.emplace_back(key, Json());
        }
        return member(it->second).second;
    }
    void take_out(const std::string& key) { any_out_ = index_.erase(key) != 0 || any_out_; }
    /// Does what was asked of take_out().
    void finish() {
        if (any_out_) {
            Json::object_t kept;
            for (std::size_t i = 0; i < members_.size(); ++i) {
                const auto hit = index_.find(member(i).first);
                if (hit != index_.end() && hit->second == i) {
                    kept.emplace_back(member(i).first, std::move(member(i).second));
                }
            }
            members_ = std::move(kept);
        }
    }

  private:
    Json::object_t::value_type& member(std::size_t i) {
        return *(members_.begin() + static_cast<std::ptrdiff_t>(i));
    }

    Json::object_t& members_;
    std::unordered_map<std::string, std::size_t> index_;
    bool any_out_ = false;
};

void overlay(Document& base, const Document& over, Json& target, const Json& patch,
             const std::string& pointer, std::size_t file_shift) {
    Members members(target);
    for (const auto& [key, value] : patch.items()) {
        const std::string where = pointer + "/" + escape_pointer(key);
        if (value.is_null()) {
            members.take_out(key);
            forget_places(base, where);
        } else if (value.is_object()) {
            Json& member = members.at(key);
            if (!member.is_object()) {
                forget_places(base, where);
                member = Json::object();
                const auto place = over.places.find(where);
                base.places[where] = {place->second.file + file_shift, place->second.line};
            }
            overlay(base, over, member, value, where, file_shift);
        } else {
            forget_places(base, where);
            members.at(key) = value;
            take_places(base, over, where, file_shift);
        }
    }
    members.finish();
}

}  // namespace

std::string Problem::sentence() const {
    std::string out = file;
    if (line != 0) {
        out += ':' + std::to_string(line);
    }
    out += ": ";
    if (!pointer.empty()) {
        out += pointer + ": ";
    }
    out += message;
    if (!nearest.empty()) {
        out += "; did you mean \"" + nearest + "\"?";
    }
    return out;
}

namespace {
std::string all_sentences(const std::vector<Problem>& problems) {
    std::string out;
    for (const Problem& problem : problems) {
        out += (out.empty() ? "" : "\n") + problem.sentence();
    }
    return out;
}
}  // namespace

ProfileError::ProfileError(std::vector<Problem> problems)
    : std::runtime_error(all_sentences(problems)), problems_(std::move(problems)) {}

Problem Document::problem(std::string_view pointer, std::string message, std::string nearest) const {
    // A value that was never written stands where its nearest parent does.
    std::string_view at = pointer;
    auto hit = places.find(at);
    while (hit == places.end() && !at.empty()) {
        at = at.substr(0, at.rfind('/'));
        hit = places.find(at);
    }
    Problem out;
    const Place place = hit == places.end() ? Place{} : hit->second;
    out.file = place.file < files.size() ? files[place.file] : std::string{};
    out.line = place.line;
    out.pointer = std::string(pointer);
    out.message = std::move(message);
    out.nearest = std::move(nearest);
    return out;
}

Document parse_document(const SourceText& source) {
    Document document;
    document.files.push_back(source.name);
    Cursor cursor;
    Builder builder(document, cursor);
    const char* begin = source.text.data();
    const bool parsed = Json::sax_parse(CountingIterator(begin, &cursor),
                                        CountingIterator(begin + source.text.size(), &cursor), &builder);
    if (!builder.problems.empty()) {
        throw ProfileError(std::move(builder.problems));
    }
    if (!parsed || !document.root.is_object()) {
        throw ProfileError({document.problem("", "expected a JSON object")});
    }
    return document;
}

namespace {

std::optional<SourceText> extended(const Document& top, const std::string& name, const SourceFinder& find) {
    try {
        if (auto found = find(name, top.files.front())) {
            return found;
        }
    } catch (const UnknownSource& unknown) {
        Problem problem = top.problem("/extends", unknown.what());
        problem.nearest = unknown.nearest;
        throw ProfileError({problem});
    }
    throw ProfileError({top.problem("/extends", "there is no profile \"" + name + '"')});
}

}  // namespace

Document load_document(const SourceText& source, const SourceFinder& find) {
    std::vector<Document> chain;
    chain.push_back(parse_document(source));
    while (chain.back().root.contains("extends")) {
        const Document& top = chain.back();
        const Json& name = top.root["extends"];
        if (!name.is_string()) {
            throw ProfileError({top.problem("/extends", "expected the name of a profile")});
        }
        if (chain.size() == max_chain) {
            throw ProfileError({top.problem("/extends", "more than 8 profiles extend one another")});
        }
        const auto parent = extended(top, name.get<std::string>(), find);
        const bool circle = std::any_of(chain.begin(), chain.end(),
                                        [&](const Document& d) { return d.files.front() == parent->name; });
        if (circle) {
            throw ProfileError({top.problem("/extends", "the profiles extend one another in a circle")});
        }
        chain.push_back(parse_document(*parent));
    }
    Document result = std::move(chain.back());
    for (auto over = std::next(chain.rbegin()); over != chain.rend(); ++over) {
        const std::size_t shift = result.files.size();
        result.files.push_back(over->files.front());
        overlay(result, *over, result.root, over->root, "", shift);
        take_places(result, *over, "/extends", shift);
        result.places[""] = {shift, 1};
    }
    return result;
}

}  // namespace fauxboard::behaviour
