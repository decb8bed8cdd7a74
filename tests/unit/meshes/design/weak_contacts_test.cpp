#include "meshes/design/weak_contacts.h"

#include <gtest/gtest.h>

#include "meshes/design/reference_shapes.h"

namespace menger::meshes {
namespace {

TEST(WeakContacts, FindsContactsAlongAnEdgeInEveryPlane) {
  EXPECT_EQ(first_weak_contact(Polycube::from_digits(2, 2, 1, "1001")), (WeakContact{{0, 0, 0}, {1, 1, 0}}));
  EXPECT_EQ(first_weak_contact(Polycube::from_digits(2, 2, 1, "0110")), (WeakContact{{1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(first_weak_contact(Polycube::from_digits(2, 1, 2, "1001")), (WeakContact{{0, 0, 0}, {1, 0, 1}}));
  EXPECT_EQ(first_weak_contact(Polycube::from_digits(2, 1, 2, "0110")), (WeakContact{{1, 0, 0}, {0, 0, 1}}));
  EXPECT_EQ(first_weak_contact(Polycube::from_digits(1, 2, 2, "1001")), (WeakContact{{0, 0, 0}, {0, 1, 1}}));
  EXPECT_EQ(first_weak_contact(Polycube::from_digits(1, 2, 2, "0110")), (WeakContact{{0, 1, 0}, {0, 0, 1}}));
}

TEST(WeakContacts, FindsContactsAtACornerOnEveryDiagonal) {
  EXPECT_EQ(first_weak_contact(Polycube::from_digits(2, 2, 2, "10000001")), (WeakContact{{0, 0, 0}, {1, 1, 1}}));
  EXPECT_EQ(first_weak_contact(Polycube::from_digits(2, 2, 2, "01000010")), (WeakContact{{1, 0, 0}, {0, 1, 1}}));
  EXPECT_EQ(first_weak_contact(Polycube::from_digits(2, 2, 2, "00100100")), (WeakContact{{0, 1, 0}, {1, 0, 1}}));
  EXPECT_EQ(first_weak_contact(Polycube::from_digits(2, 2, 2, "00011000")), (WeakContact{{1, 1, 0}, {0, 0, 1}}));
}

TEST(WeakContacts, FindsAnEdgeEvenIfItsCellsAreJoinedElsewhere) {
  // Two columns that touch along an edge and stand on a common plate.
  EXPECT_EQ(first_weak_contact(Polycube::from_digits(2, 2, 2, "11111001")), (WeakContact{{0, 0, 1}, {1, 1, 1}}));
}

TEST(WeakContacts, AcceptsWhatOtherCellsJoin) {
  EXPECT_FALSE(first_weak_contact(Polycube::from_digits(2, 2, 1, "1101")));
  EXPECT_FALSE(first_weak_contact(Polycube::from_digits(2, 2, 2, "11010001")));
  EXPECT_FALSE(first_weak_contact(menger_sponge()));
  EXPECT_FALSE(first_weak_contact(full_cube(3)));
}

TEST(WeakContacts, AreCountedAlongEdgesOnly) {
  EXPECT_EQ(count_edge_contacts(Polycube::from_digits(2, 2, 2, "10010000")), 1U);
  EXPECT_EQ(count_edge_contacts(Polycube::from_digits(2, 2, 2, "10000001")), 0U) << "a corner";
  EXPECT_EQ(count_edge_contacts(Polycube::from_digits(2, 2, 2, "11010000")), 0U) << "a third cell joins them";
  EXPECT_EQ(count_edge_contacts(Polycube::from_digits(2, 2, 2, "10010110")), 6U) << "each two of four cells";
}

}  // namespace
}  // namespace menger::meshes
