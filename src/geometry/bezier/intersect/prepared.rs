use super::power::PowerForm;
use crate::geometry::bezier::ControlNet;
use crate::geometry::bezier::tree::SubpatchTree;
use crate::geometry::bezier::unit::SoaNet;

/// A patch in unit space in the forms that intersection reads.
#[derive(Clone, Debug)]
pub(crate) struct PreparedPatch {
    pub(crate) net: SoaNet,
    pub(crate) power: PowerForm,
    pub(crate) tree: SubpatchTree,
}

impl PreparedPatch {
    /// Cuts the patch that has this net in unit space, and builds its tree.
    pub(crate) fn new(unit_net: &ControlNet) -> Self {
        let net = SoaNet::new(unit_net);
        Self { net, power: PowerForm::new(unit_net), tree: SubpatchTree::new(&net) }
    }
}
